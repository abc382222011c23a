import { describe, expect, it } from "vitest";

import { tierOf } from "./measure-tier";

describe("tierOf", () => {
  it("gives a fast card everything, a slow one less, and software the least", () => {
    expect(tierOf(0.1, false)).toBe("full");
    expect(tierOf(15, false)).toBe("medium");
    expect(tierOf(300, false)).toBe("low");
  });

  it("spares a battery", () => {
    expect(tierOf(0.1, true)).toBe("medium");
    expect(tierOf(300, true)).toBe("low");
  });

  it("never gives a slower device more", () => {
    const order = ["low", "medium", "full"];
    const ranks = [0.2, 1, 5, 7, 30, 50, 500].map((time) => order.indexOf(tierOf(time, false)));
    expect(ranks).toEqual([...ranks].sort((a, b) => b - a));
  });
});
