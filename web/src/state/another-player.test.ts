import { describe, expect, it } from "vitest";

import { anothers } from "./another-player";

const THERE = [
  { name: "trumpet", seat: null },
  { name: "cornet", seat: null },
  { name: "drums", seat: "drums" },
];
const cast = (...names: string[]) => names.map((instrument) => ({ instrument }));

describe("anothers", () => {
  it("is the last player's instrument, but no second one of what has a seat of its own", () => {
    expect(anothers(THERE, cast("trumpet", "cornet"))).toBe("cornet");
    expect(anothers(THERE, cast("cornet", "drums"))).toBe("cornet");
    expect(anothers(THERE, cast("drums"))).toBe("trumpet");
    expect(anothers([], cast("drums"))).toBeUndefined();
  });
});
