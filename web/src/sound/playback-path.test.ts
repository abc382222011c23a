import { describe, expect, it } from "vitest";
import { PlaybackPath } from "./playback-path";

describe("PlaybackPath", () => {
  it("runs at its rate from where it began", () => {
    const path = new PlaybackPath(100, 30, 0.5, null);
    expect(path.positionAt(104)).toBe(32);
  });

  it("follows changes of the rate, one leg after another", () => {
    const path = new PlaybackPath(0, 10, 1, null);
    path.changeRate(5, 1.03);
    path.changeRate(6, 1);
    expect(path.positionAt(4)).toBe(14);
    expect(path.positionAt(5.5)).toBeCloseTo(15.515, 9);
    expect(path.positionAt(8)).toBeCloseTo(18.03, 9);
  });

  it("goes round its loop, and measures the error the shorter way round", () => {
    const path = new PlaybackPath(0, 8, 1, { start_s: 4, end_s: 10, count_in_s: 0 });
    expect(path.positionAt(1)).toBe(9);
    expect(path.positionAt(3)).toBe(5);
    expect(path.positionAt(9)).toBe(5);
    expect(path.errorAt(1.9, 4.05)).toBeCloseTo(-0.15, 9);
    expect(path.errorAt(2.1, 9.95)).toBeCloseTo(0.15, 9);
  });

  it("stands where it begins until then, and at the loop's begin while that is counted in", () => {
    const path = new PlaybackPath(2, 8, 1, { start_s: 4, end_s: 10, count_in_s: 3 });
    expect([1, 2, 3, 4, 5, 7, 8].map((at) => path.positionAt(at))).toEqual([8, 8, 9, 4, 4, 4, 5]);
    expect([1, 2, 3, 4, 5, 7, 8].map((at) => path.countInAt(at))).toEqual([1, 0, 0, 3, 2, 0, 0]);
  });

  it("is told in pieces, what is counted in among them", () => {
    const path = new PlaybackPath(2, 8, 2, { start_s: 4, end_s: 10, count_in_s: 3 });
    expect(path.piecesBetween(path.unfoldedAt(1.5), path.unfoldedAt(8))).toEqual([
      { from: 7, to: 8, shift: 0, countsTo: 8 },
      { from: 8, to: 10, shift: 0, countsTo: null },
      { from: 1, to: 4, shift: 9, countsTo: 4 },
      { from: 4, to: 10, shift: 9, countsTo: null },
      { from: 1, to: 2, shift: 18, countsTo: 4 },
    ]);
    expect(path.timeAt(4 + 9)).toBe(4.5);
  });

  it("goes on from within a round, or without a loop", () => {
    const path = new PlaybackPath(0, 5, 1, { start_s: 4, end_s: 6, count_in_s: 0 });
    expect(path.piecesBetween(9, 11)).toEqual([
      { from: 5, to: 6, shift: 4, countsTo: null },
      { from: 4, to: 5, shift: 6, countsTo: null },
    ]);
    expect(new PlaybackPath(0, 5, 1, null).piecesBetween(9, 11)).toEqual([
      { from: 9, to: 11, shift: 0, countsTo: null },
    ]);
  });
});
