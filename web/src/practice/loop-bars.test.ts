import { describe, expect, it } from "vitest";
import { allBars, barsAround, spanOfBars, withEnd } from "./loop-bars";

/** A pickup of a quarter, three bars of 4/4 at 120, and a last one of 3/4. */
const score = {
  tempi: [{ onset_beats: 0, onset_s: 0, bpm: 120 }],
  metres: [
    { onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 },
    { onset_beats: 13, onset_s: 6.5, numerator: 3, denominator: 4 },
  ],
  bar_lines_s: [0, 0.5, 2.5, 4.5, 6.5],
};

describe("bars of a loop", () => {
  it("are numbered as the score's are, the pickup 0", () => {
    expect(allBars(score)).toEqual({ from: 0, to: 4 });
    expect(spanOfBars(score, { from: 0, to: 0 }, 60)).toEqual({ start: 0, end: 0.5 });
    expect(spanOfBars(score, { from: 1, to: 2 }, 60)).toEqual({ start: 0.5, end: 4.5 });
  });

  it("end with the last bar, or with the song", () => {
    expect(spanOfBars(score, { from: 4, to: 4 }, 60)).toEqual({ start: 6.5, end: 8 });
    expect(spanOfBars(score, { from: 4, to: 4 }, 7)).toEqual({ start: 6.5, end: 7 });
  });

  it("are the nearest that are heard where a recording leaves them out", () => {
    const cut = { ...score, bar_lines_s: [3, 3, 3, 5, 7, 7], tempi: [{ onset_beats: 0, onset_s: 3, bpm: 6e9 }] };
    expect(spanOfBars(cut, { from: 1, to: 1 }, 7)).toEqual({ start: 3, end: 5 });
    expect(spanOfBars(cut, { from: 4, to: 5 }, 7)).toEqual({ start: 5, end: 7 });
  });

  it("are those that a span lies in, and the same again of their own span", () => {
    expect(barsAround(score, { start: 1, end: 3 })).toEqual({ from: 1, to: 2 });
    expect(barsAround(score, { start: 3, end: 3.1 })).toEqual({ from: 2, to: 2 });
    for (const bars of [
      { from: 0, to: 4 },
      { from: 2, to: 3 },
    ]) {
      expect(barsAround(score, spanOfBars(score, bars, 60))).toEqual(bars);
    }
  });

  it("take their other end along", () => {
    const all = { from: 0, to: 4 };
    expect(withEnd({ from: 1, to: 2 }, "from", 3, all)).toEqual({ from: 3, to: 3 });
    expect(withEnd({ from: 2, to: 3 }, "to", 1, all)).toEqual({ from: 1, to: 1 });
    expect(withEnd({ from: 2, to: 3 }, "to", 9, all)).toEqual({ from: 2, to: 4 });
  });
});
