import { describe, expect, it, vi } from "vitest";
import { ProblemError } from "../connection";
import { Notices } from "./notices.svelte";
import { UnsentChanges } from "./unsent-changes";

const away = new ProblemError({ status: 0, title: "The server does not answer", detail: "", errors: [] });
const here = (): boolean => false;

describe("UnsentChanges", () => {
  it("tell each change that did not get there, also once the server answers, and make all of them again", () => {
    const notices = new Notices();
    const unsent = new UnsentChanges(notices);
    const made: string[] = [];
    unsent.tell(away, () => made.push("part"), here);
    expect(notices.current?.title).toBe("This was not changed");
    unsent.tell(away, () => made.push("seat"), here);
    expect(notices.current?.title).toBe("2 changes were not made");
    notices.answered();
    expect(notices.waits).toBe(true);
    notices.current?.actions[0]?.run();
    expect(made).toEqual(["part", "seat"]);
  });

  it("forget what was put away, and leave what was refused to be told as it is", () => {
    const notices = new Notices();
    const unsent = new UnsentChanges(notices);
    const [first, second] = [vi.fn(), vi.fn()];
    unsent.tell(away, first, here);
    notices.clear();
    unsent.tell(away, second, here);
    notices.current?.actions[0]?.run();
    expect(first).not.toHaveBeenCalled();
    expect(second).toHaveBeenCalledOnce();
    unsent.tell(new ProblemError({ status: 403, title: "Not yours", detail: "", errors: [] }), first, here);
    expect(notices.current).toMatchObject({ title: "Not yours", actions: [] });
  });
});
