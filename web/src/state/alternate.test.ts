import { describe, expect, it } from "vitest";
import { isAlternate } from "./alternate";

describe("isAlternate", () => {
  it.each([
    [[2], [2], false],
    [[1, 2, 3], [2], true],
    [[], [1, 3], true],
    [null, null, false],
  ])("of %j, where %j is usual: %s", (valves, usual_valves, expected) => {
    expect(isAlternate({ valves, usual_valves })).toBe(expected);
  });
});
