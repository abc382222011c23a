import { describe, expect, it } from "vitest";

import { countOf, faultOf, framesOf, piecesOf, secondsOf } from "./span";

describe("the frames of a span", () => {
  it.each([
    [0, 1, 60, 0, 60],
    [0.5, 1.5, 30, 15, 45],
    [1 / 60, 2 / 60, 60, 1, 2],
    // Between two frames: those that lie within.
    [0.51, 0.99, 10, 6, 10],
    // What floating point makes of thirds.
    [71 / 30, 73 / 30, 30, 71, 73],
    [3599.9, 3600, 60, 215_994, 216_000],
  ])("from %f to %f at %i", (start, end, fps, first, beyond) => {
    expect(framesOf({ start, end }, fps)).toEqual({ first, end: beyond, fps });
  });

  it("are one at least", () => {
    expect(countOf(framesOf({ start: 1.001, end: 1.002 }, 30))).toBe(1);
  });

  it("are cut into pieces without a gap", () => {
    const pieces = piecesOf({ first: 7, end: 507, fps: 60 }, 240);
    expect(pieces.map(({ first, end }) => [first, end])).toEqual([
      [7, 247],
      [247, 487],
      [487, 507],
    ]);
    expect(piecesOf({ first: 0, end: 240, fps: 60 }, 240)).toHaveLength(1);
  });
});

describe("a span", () => {
  it.each([
    [{ start: 0, end: 10 }, null],
    [{ start: Number.NaN, end: 10 }, "minutes and seconds"],
    [{ start: -1, end: 10 }, "before the music"],
    [{ start: 60, end: 70 }, "after the music"],
    [{ start: 5, end: 5 }, "end after it begins"],
  ])("%o", (span, fault) => {
    const found = faultOf(span, 60);
    if (fault === null) expect(found).toBeNull();
    else expect(found).toContain(fault);
  });
});

describe("a written time", () => {
  it.each([
    ["1:02.5", 62.5],
    [" 62,5 ", 62.5],
    ["0:07", 7],
    ["90", 90],
    ["1:2:3", Number.NaN],
    ["", Number.NaN],
    ["-3", Number.NaN],
    ["1e9", Number.NaN],
  ])("%s", (text, seconds) => {
    expect(secondsOf(text)).toBe(seconds);
  });
});
