import { describe, expect, it } from "vitest";
import { toSongTime, toTrackTime } from "./show-document";

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
    expect(toTrackTime(score, unit, songTime)).toBeCloseTo(trackTime, 9);
    expect(toSongTime(score, unit, trackTime)).toBeCloseTo(songTime, 9);
  });

  it("has bars even where the score has no bar lines", () => {
    const empty = { tempi: [], bar_lines_s: [] };
    expect(toTrackTime(empty, "bars", 3)).toBeCloseTo(1.5, 9);
    expect(toSongTime(empty, "bars", 1.5)).toBeCloseTo(3, 9);
  });
});
