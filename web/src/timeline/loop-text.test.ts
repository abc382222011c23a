import { expect, it } from "vitest";
import { loopText } from "./loop-text";

it("a loop is said by its bars, or by bar and beat where it is free of them", () => {
  const score = {
    tempi: [{ onset_beats: 0, onset_s: 0, bpm: 120 }],
    metres: [{ onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 }],
    bar_lines_s: [0, 2, 4, 6, 8],
  };
  expect(loopText(score, { start: 2, end: 6 }, 9)).toBe("Bars 2 to 3");
  expect(loopText(score, { start: 2, end: 4 }, 9)).toBe("Bar 2");
  expect(loopText(score, { start: 6, end: 9 }, 9)).toBe("Bars 4 to 5");
  expect(loopText(score, { start: 2.5, end: 6 }, 9)).toBe("2·2 to 4·1");
});
