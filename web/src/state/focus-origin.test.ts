import { describe, expect, it } from "vitest";
import { FocusOrigin } from "./focus-origin";

/** A page whose events can be sent by name. */
function page() {
  const heard = new Map<string, () => void>();
  const addEventListener = (type: string, listener: () => void): void => void heard.set(type, listener);
  const origin = new FocusOrigin({ addEventListener } as unknown as Window);
  return { origin, send: (...types: string[]) => types.forEach((type) => heard.get(type)?.()) };
}

describe("FocusOrigin", () => {
  it("knows a click from Tab, also where the focus was there already", () => {
    expectOrigin(["pointerdown", "focusin", "pointerup"], true);
    expectOrigin(["pointerdown", "pointerup", "mousedown", "focusin", "mouseup"], true);
    expectOrigin(["focusin"], false);
    expectOrigin(["focusin", "pointerdown", "pointerup"], true);
    expectOrigin(["pointerdown", "focusin", "pointerup", "focusin"], false);
  });
});

function expectOrigin(events: string[], byPointer: boolean): void {
  const { origin, send } = page();
  send(...events);
  expect(origin.byPointer, events.join(" ")).toBe(byPointer);
}
