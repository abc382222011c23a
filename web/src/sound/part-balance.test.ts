import { describe, expect, it } from "vitest";
import { AS_WRITTEN, isAsWritten, queriesOf } from "./hearing";
import { stemGains } from "./part-balance";

describe("stemGains", () => {
  it("are the whole in the middle, and one stem alone at each end", () => {
    expect(stemGains(0)).toEqual({ part: 1, rest: 1 });
    expect(stemGains(1)).toEqual({ part: 1, rest: 0 });
    expect(stemGains(-1)).toEqual({ part: 0, rest: 1 });
    expect(stemGains(0.5)).toEqual({ part: 1, rest: 0.25 });
  });

  it("make nothing louder than it is in the whole", () => {
    for (let balance = -1.5; balance <= 1.5; balance += 0.1) {
      const { part, rest } = stemGains(balance);
      expect(Math.max(part, rest)).toBe(1);
      expect(Math.min(part, rest)).toBeGreaterThanOrEqual(0);
    }
  });
});

describe("queriesOf", () => {
  it("ask for one song, or for the part and the rest, each at its pitch", () => {
    expect(queriesOf(AS_WRITTEN)).toEqual([""]);
    expect(queriesOf({ apart: false, player: 2, semitones: -3 })).toEqual(["?semitones=-3"]);
    expect(queriesOf({ apart: true, player: 2, semitones: 0 })).toEqual(["?stem=part&player=2", "?stem=rest&player=2"]);
    expect(queriesOf({ apart: true, player: 0, semitones: 1 })).toEqual([
      "?stem=part&player=0&semitones=1",
      "?stem=rest&player=0&semitones=1",
    ]);
  });

  it("ask for what everybody hears only where nothing is moved or apart", () => {
    expect(isAsWritten(AS_WRITTEN)).toBe(true);
    expect(isAsWritten({ apart: false, player: 0, semitones: 1 })).toBe(false);
    expect(isAsWritten({ apart: true, player: 0, semitones: 0 })).toBe(false);
  });
});
