import { describe, expect, it } from "vitest";
import { PartSound } from "./part-sound.svelte";

function kept(): Pick<Storage, "getItem" | "setItem"> {
  const items = new Map<string, string>();
  return { getItem: (key) => items.get(key) ?? null, setItem: (key, value) => void items.set(key, value) };
}

describe("PartSound", () => {
  it("is as written until somebody chooses, and then as they chose for this session", () => {
    const storage = kept();
    const first = new PartSound("one", storage);
    expect(first.hearing(1)).toEqual({ apart: false, player: 0, semitones: 0 });
    first.choose({ balance: -1 });
    first.choose({ semitones: 3 });
    expect(new PartSound("one", storage).hearing(1)).toEqual({ apart: true, player: 1, semitones: 3 });
    expect(new PartSound("two", storage).hearing(1)).toEqual({ apart: false, player: 0, semitones: 0 });
  });

  it("leaves the part apart once it is, until it is given up", () => {
    const sound = new PartSound("one", kept());
    sound.choose({ balance: 0.5 });
    expect(sound.hearing(0).apart).toBe(true);
    sound.choose({ balance: 0 });
    expect(sound.hearing(0).apart).toBe(true);
    sound.giveUp();
    expect(sound.hearing(0).apart).toBe(false);
  });

  it("keeps within what there is, and works where nothing can be kept or what is kept is broken", () => {
    const broken = {
      getItem: () => "{",
      setItem: () => {
        throw new DOMException("full");
      },
    };
    const sound = new PartSound("one", broken);
    sound.choose({ balance: 7, semitones: -40 });
    expect([sound.balance, sound.semitones]).toEqual([1, -12]);
    expect(new PartSound("one", null).balance).toBe(0);
  });

  it("remembers the latest sessions only", () => {
    const storage = kept();
    for (let number = 0; number < 60; number += 1) new PartSound(`s${number}`, storage).choose({ balance: 1 });
    expect(new PartSound("s0", storage).balance).toBe(0);
    expect(new PartSound("s59", storage).balance).toBe(1);
  });
});
