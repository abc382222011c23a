import { describe, expect, it } from "vitest";
import { Refresh } from "./refresh";

function turned(interval: number, turns = 20): Refresh {
  const refresh = new Refresh();
  for (let turn = 0; turn < turns; turn++) refresh.seenAt(turn * interval, turn * interval + 0.001);
  return refresh;
}

describe("Refresh", () => {
  it("takes what is drawn to be seen one turn later", () => {
    expect(new Refresh().seenAt(5, 5.002)).toBeCloseTo(5 + 1 / 60, 9);
    expect(turned(1 / 144).seenAt(5, 5.001)).toBeCloseTo(5 + 1 / 144, 9);
  });

  it("is not misled by single turns that took long, nor by pauses", () => {
    const refresh = turned(1 / 60);
    refresh.seenAt(0.5, 0.5);
    refresh.seenAt(60, 60);
    expect(refresh.interval).toBeCloseTo(1 / 60, 9);
  });

  it("looks no further ahead than a thirtieth of a second", () => {
    expect(turned(0.12).interval).toBe(1 / 30);
  });

  it("counts from now where the turn has waited", () => {
    expect(new Refresh().seenAt(5, 5.2)).toBeCloseTo(5.2, 9);
  });
});
