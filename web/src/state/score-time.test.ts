import { describe, expect, it } from "vitest";
import { barBeatAt, barIndexAt, beatsAt, firstBarNumber, neighbouringBarLine } from "./score-time";

/** A pickup of one quarter at 60, then 3/4; from bar 3 on at 120 in 6/8. */
const score = {
  tempi: [
    { onset_beats: 0, onset_s: 0, bpm: 60 },
    { onset_beats: 7, onset_s: 7, bpm: 120 },
  ],
  metres: [
    { onset_beats: 0, onset_s: 0, numerator: 3, denominator: 4 },
    { onset_beats: 7, onset_s: 7, numerator: 6, denominator: 8 },
  ],
  bar_lines_s: [0, 1, 4, 7, 8.5, 10],
};

describe("score time", () => {
  it("tells beats through a change of tempo", () => {
    expect(beatsAt(score.tempi, 4)).toBe(4);
    expect(beatsAt(score.tempi, 8)).toBe(9);
  });

  it("finds the bar that a time falls in", () => {
    expect([0, 0.5, 1, 3.9, 7, 99].map((time) => barIndexAt(score.bar_lines_s, time))).toEqual([0, 0, 1, 1, 3, 5]);
  });

  it("calls a pickup bar 0", () => {
    expect(firstBarNumber(score)).toBe(0);
    expect(firstBarNumber({ ...score, bar_lines_s: [0, 3, 6] })).toBe(1);
    expect(barBeatAt(score, 0.2)).toEqual({ bar: 0, beat: 1 });
    expect(barBeatAt(score, 1)).toEqual({ bar: 1, beat: 1 });
    expect(barBeatAt(score, 3.1)).toEqual({ bar: 1, beat: 3 });
  });

  it("counts eighths in 6/8", () => {
    expect(barBeatAt(score, 7.0)).toEqual({ bar: 3, beat: 1 });
    expect(barBeatAt(score, 8.26)).toEqual({ bar: 3, beat: 6 });
    expect(barBeatAt(score, 8.5)).toEqual({ bar: 4, beat: 1 });
  });

  it("counts back before the music begins", () => {
    const later = {
      tempi: [{ onset_beats: 0, onset_s: 4, bpm: 60 }],
      metres: [{ onset_beats: 0, onset_s: 4, numerator: 3, denominator: 4 }],
      bar_lines_s: [4, 7, 10],
    };
    expect(barBeatAt(later, 4)).toEqual({ bar: 1, beat: 1 });
    expect(barBeatAt(later, 3.5)).toEqual({ bar: 0, beat: 3 });
    expect(barBeatAt(later, 0)).toEqual({ bar: -1, beat: 3 });
  });

  it("counts back from the first bar that is heard where a recording leaves out the beginning", () => {
    const cut = {
      tempi: [
        { onset_beats: 0, onset_s: 4, bpm: 6e9 },
        { onset_beats: 3, onset_s: 4, bpm: 6e9 },
        { onset_beats: 6, onset_s: 4, bpm: 60 },
      ],
      metres: [{ onset_beats: 0, onset_s: 4, numerator: 3, denominator: 4 }],
      bar_lines_s: [4, 4, 4, 7],
    };
    expect(barBeatAt(cut, 4)).toEqual({ bar: 3, beat: 1 });
    expect(barBeatAt(cut, 3.5)).toEqual({ bar: 2, beat: 3 });
    expect(barBeatAt(cut, 0)).toEqual({ bar: 1, beat: 3 });
    const pickup = { ...cut, tempi: [...cut.tempi.slice(0, 2), { onset_beats: 4, onset_s: 4, bpm: 60 }] };
    expect(firstBarNumber(cut)).toBe(1);
    expect(firstBarNumber(pickup)).toBe(0);
  });

  it("goes from bar line to bar line", () => {
    expect(neighbouringBarLine(score, 1, 1, 12)).toBe(4);
    expect(neighbouringBarLine(score, 10.5, 1, 12)).toBe(12);
    expect(neighbouringBarLine(score, 6, -1, 12)).toBe(4);
    expect(neighbouringBarLine(score, 4.1, -1, 12)).toBe(1);
    expect(neighbouringBarLine(score, 0.1, -1, 12)).toBe(0);
  });
});
