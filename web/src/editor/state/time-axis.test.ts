import { describe, expect, it } from "vitest";
import { TimeAxis } from "./time-axis";

/** Two bars of 4/4 at 120, then 60. */
const score = {
  tempi: [
    { onset_beats: 0, onset_s: 0, bpm: 120 },
    { onset_beats: 8, onset_s: 4, bpm: 60 },
  ],
  bar_lines_s: [0, 2, 4, 8],
};

describe("a track's time", () => {
  it.each([
    ["seconds", 5, 5],
    ["beats", 5, 9],
    ["bars", 1, 0.5],
    ["bars", 5, 2.25],
    ["bars", 10, 3.5],
  ] as const)("in %s, song time %f is %f, and back", (unit, songTime, trackTime) => {
    expect(new TimeAxis(score).toTrackTime(unit, songTime)).toBeCloseTo(trackTime, 9);
    expect(new TimeAxis(score).toSongTime(unit, trackTime)).toBeCloseTo(songTime, 9);
  });

  it("has bars even where the score has no bar lines", () => {
    const empty = new TimeAxis({ tempi: [], bar_lines_s: [] });
    expect(empty.toTrackTime("bars", 3)).toBeCloseTo(1.5, 9);
    expect(empty.toSongTime("bars", 1.5)).toBeCloseTo(3, 9);
  });

  it("knows how long a bar lasts", () => {
    const axis = new TimeAxis(score);
    expect(axis.barLengthAt(1)).toBe(4);
    expect(axis.barLengthAt(40)).toBe(4);
  });
});
