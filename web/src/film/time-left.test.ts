import { describe, expect, it } from "vitest";

import { TimeLeft, lengthOfTime } from "./time-left";

describe("the time that is left", () => {
  it("is not known in the first second", () => {
    const left = new TimeLeft(100);
    expect(left.mark(1, 10)).toBeNull();
    expect(left.mark(5, 10.5)).toBeNull();
    expect(left.mark(11, 11)).toBeCloseTo(8.9);
  });

  it("follows the pace of the last seconds", () => {
    const left = new TimeLeft(10_000);
    for (let second = 0; second <= 100; second++) left.mark(second * 10, second);
    let said: number | null = null;
    for (let second = 1; second <= 20; second++) said = left.mark(1000 + second * 50, 100 + second);
    expect(said).toBeCloseTo(8000 / 50);
  });

  it("is known of frames that take longer than the look", () => {
    const left = new TimeLeft(10);
    left.mark(1, 0);
    left.mark(2, 30);
    expect(left.mark(3, 60)).toBeCloseTo(210);
  });

  it("is not known of work that stands still", () => {
    const left = new TimeLeft(10);
    left.mark(0, 0);
    expect(left.mark(0, 60)).toBeNull();
  });

  it.each([
    [0.2, "about 5 s"],
    [23, "about 25 s"],
    [49.5, "about 50 s"],
    [61, "about 2 min"],
    [3590, "about 1 h 0 min"],
    [5000, "about 1 h 30 min"],
  ])("%f s", (seconds, said) => {
    expect(lengthOfTime(seconds)).toBe(said);
  });
});
