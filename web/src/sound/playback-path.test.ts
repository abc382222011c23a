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
});
