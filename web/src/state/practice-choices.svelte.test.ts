import { describe, expect, it } from "vitest";
import type { Score } from "../generated/protocol";
import { PracticeChoices } from "./practice-choices.svelte";

/** 4/4 at 120. */
const march = {
  tempi: [{ onset_beats: 0, onset_s: 0, bpm: 120 }],
  metres: [{ onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 }],
  bar_lines_s: [0, 2, 4, 6],
} as unknown as Score;

const counting = (from: number, to: number) => ({ from, to, shift: 0, countsTo: 2 });

describe("PracticeChoices", () => {
  it("counts in so many bars, with a lead that has no click of its own", () => {
    const choices = new PracticeChoices();
    choices.countInBars = 1;
    choices.metronome = true;
    choices.division = "eighths";
    const counted = choices.countInTo(march, 2, 2);
    expect(counted).toBeCloseTo(2.5, 9);
    const given = { counted, rate: 2, heard: true };
    const clicks = choices.clicksIn(march, counting(-0.5, 2), given);
    expect(clicks.map(({ songTime }) => songTime)).toEqual([0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75]);
    const late = choices.clicksIn(march, counting(1.1, 1.6), given);
    expect(late.map(({ songTime }) => songTime)).toEqual([1.25, 1.5]);
  });

  it("goes on with what is left of a count-in, whatever beat it is in", () => {
    const choices = new PracticeChoices();
    const clicks = choices.clicksIn(march, counting(0.45, 2), { counted: 1.55, rate: 1, heard: true });
    expect(clicks.map(({ songTime }) => songTime)).toEqual([0.5, 1, 1.5]);
  });

  it("is silent where neither the metronome nor the page's sound is on", () => {
    const choices = new PracticeChoices();
    const song = { from: 2, to: 4, shift: 0, countsTo: null };
    const heard = { counted: 2, rate: 1, heard: true };
    expect(choices.clicksIn(march, song, heard)).toEqual([]);
    expect(choices.clicksIn(march, counting(0, 2), { ...heard, heard: false })).toEqual([]);
    choices.metronome = true;
    expect(choices.clicksIn(march, song, { ...heard, heard: false })).toHaveLength(4);
    expect(choices.clicksIn(march, counting(0, 2), { ...heard, heard: false })).toHaveLength(4);
  });

  it("counts in rounds where that was chosen, without a pause", () => {
    const choices = new PracticeChoices();
    choices.countInBars = 2;
    expect(choices.countInOfRounds(march, 2)).toBe(0);
    choices.countInRounds = true;
    expect(choices.countInOfRounds(march, 2)).toBeCloseTo(4, 9);
  });
});
