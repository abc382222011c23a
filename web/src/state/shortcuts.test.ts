import { describe, expect, it } from "vitest";
import { ariaKeys, hint, SHORTCUTS, shortcutOf, STAGE_SHORTCUTS, type KeyPress } from "./shortcuts";

function press(key: string, change: Partial<KeyPress> = {}): KeyPress {
  return { key, shiftKey: false, ctrlKey: false, metaKey: false, altKey: false, repeat: false, ...change };
}

describe("shortcuts", () => {
  it("finds what a key does, with and without Shift", () => {
    expect(shortcutOf(press(" "))?.action).toBe("toggle");
    expect(shortcutOf(press("ArrowLeft"))?.action).toBe("back");
    expect(shortcutOf(press("ArrowLeft", { shiftKey: true }))?.action).toBe("barBack");
    expect(shortcutOf(press("M", { shiftKey: true }))?.action).toBe("mute");
    expect(shortcutOf(press("?", { shiftKey: true }))?.action).toBe("help");
    expect(shortcutOf(press("+", { shiftKey: true }))?.action).toBe("faster");
  });

  it("leaves the browser its own", () => {
    expect(shortcutOf(press("f", { ctrlKey: true }))).toBeNull();
    expect(shortcutOf(press("ArrowLeft", { altKey: true }))).toBeNull();
    expect(shortcutOf(press("q"))).toBeNull();
  });

  it("repeats only what is meant to be repeated", () => {
    expect(shortcutOf(press(" ", { repeat: true }))).toBeNull();
    expect(shortcutOf(press("ArrowRight", { repeat: true }))?.action).toBe("forward");
  });

  it("gives the stage its arrows and signs while it has the focus, and the page the rest", () => {
    expect(shortcutOf(press("ArrowLeft"), true)?.action).toBe("orbitLeft");
    expect(shortcutOf(press("ArrowUp", { repeat: true }), true)?.action).toBe("orbitUp");
    expect(shortcutOf(press("-"), true)?.action).toBe("further");
    expect(shortcutOf(press("ArrowLeft", { shiftKey: true }), true)?.action).toBe("barBack");
    expect(shortcutOf(press(" "), true)?.action).toBe("toggle");
  });

  it.each([SHORTCUTS, STAGE_SHORTCUTS])(
    "gives every key press one meaning, and every action a hint",
    (...shortcuts) => {
      const presses = shortcuts.flatMap(({ keys, shift }) =>
        keys.map((key) => `${shift === true ? "Shift " : ""}${key}`),
      );
      expect(new Set(presses).size).toBe(presses.length);
      for (const { action, says } of shortcuts) expect(hint(action)).toContain(says);
      expect(hint("mute", "Sound off")).toBe("Sound off (M)");
      expect([ariaKeys("toggle"), ariaKeys("barBack"), ariaKeys("faster")]).toEqual([
        "Space",
        "Shift+ArrowLeft",
        "Plus",
      ]);
    },
  );
});
