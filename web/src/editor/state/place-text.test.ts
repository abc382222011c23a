import { describe, expect, it } from "vitest";
import { placeText, placeTyped } from "./place-text";
import { TimeAxis } from "./time-axis";

/** A pickup of one beat, then 4/4 at 60. */
const pickup = {
  tempi: [{ onset_beats: 0, onset_s: 0, bpm: 60 }],
  metres: [{ onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 }],
  bar_lines_s: [0, 1, 5, 9],
} as never;
const axis = new TimeAxis(pickup);

describe("a place in the music as it is written", () => {
  it.each([
    [0, "0 · 1"],
    [1, "1 · 1"],
    [2.5, "1 · 2.5"],
    [5, "2 · 1"],
  ])("%f s is %s, and back", (time, text) => {
    expect(placeText(pickup, axis, time)).toBe(text);
    expect(placeTyped(pickup, axis, text)).toBeCloseTo(time, 9);
  });

  it("is taken in other spellings too, and refused where it says nothing", () => {
    expect(placeTyped(pickup, axis, "2")).toBe(5);
    expect(placeTyped(pickup, axis, "2.3")).toBe(7);
    expect(placeTyped(pickup, axis, "2 3.5")).toBe(7.5);
    expect(placeTyped(pickup, axis, "soon")).toBeNull();
    expect(placeTyped(pickup, axis, "")).toBeNull();
  });
});
