import { describe, expect, it } from "vitest";
import { ownsKey, type KeyTarget } from "./key-owner";

const NOTHING: KeyTarget = { tag: "div", type: "", editable: false, pressable: false, open: false };
const input = (type: string): KeyTarget => ({ ...NOTHING, tag: "input", type });
const BUTTON: KeyTarget = { ...NOTHING, tag: "button", pressable: true };
const SELECT: KeyTarget = { ...NOTHING, tag: "select" };

describe("ownsKey", () => {
  it("leaves text fields every key, wherever the focus came from", () => {
    for (const target of [input("text"), input("number"), input("search"), { ...NOTHING, editable: true }]) {
      for (const byPointer of [true, false]) expect(ownsKey(target, "m", byPointer)).toBe(true);
    }
  });

  it("leaves controls that the keyboard has come to the keys that they know", () => {
    expect(ownsKey(BUTTON, " ", false)).toBe(true);
    expect(ownsKey(BUTTON, "m", false)).toBe(false);
    expect(ownsKey(input("range"), "ArrowLeft", false)).toBe(true);
    expect(ownsKey(input("range"), " ", false)).toBe(false);
    expect(ownsKey(input("checkbox"), " ", false)).toBe(true);
    expect(ownsKey(input("checkbox"), "ArrowDown", false)).toBe(false);
    expect(["ArrowUp", "ArrowDown", " "].every((key) => ownsKey(input("radio"), key, false))).toBe(true);
    expect(ownsKey(input("radio"), "m", false)).toBe(false);
    expect(ownsKey(SELECT, "ArrowDown", false)).toBe(true);
  });

  it("gives the page the keys after a click", () => {
    expect(ownsKey(BUTTON, " ", true)).toBe(false);
    expect(ownsKey(input("range"), "ArrowLeft", true)).toBe(false);
    expect(ownsKey(input("radio"), "ArrowLeft", true)).toBe(false);
    expect(ownsKey(SELECT, " ", true)).toBe(false);
    expect(ownsKey({ ...SELECT, open: true }, "ArrowDown", true)).toBe(true);
  });
});
