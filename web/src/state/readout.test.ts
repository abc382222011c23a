import { describe, expect, it } from "vitest";
import { clockTime, percent, valveNames } from "./readout";

describe("readouts", () => {
  it.each([
    [0, "0:00", "0:00.0"],
    [7.96, "0:07", "0:07.9"],
    [59.999, "0:59", "0:59.9"],
    [754.3, "12:34", "12:34.3"],
    [-1, "0:00", "0:00.0"],
  ])("shows %f seconds as %s and %s", (seconds, whole, tenths) => {
    expect(clockTime(seconds)).toBe(whole);
    expect(clockTime(seconds, true)).toBe(tenths);
  });

  it("names valves and rates", () => {
    expect([[], [2], [1, 3], [1, 2, 3], null].map(valveNames)).toEqual([
      "open",
      "2",
      "1 and 3",
      "1, 2 and 3",
      "not playable",
    ]);
    expect(percent(0.75)).toBe("75 %");
  });
});
