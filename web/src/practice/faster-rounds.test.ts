import { describe, expect, it } from "vitest";
import { beganAnew, nextRound } from "./faster-rounds.svelte";

describe("rounds of a loop", () => {
  it("begin anew where song time goes back within an epoch, and only there", () => {
    expect(beganAnew({ songTime: 7.9, epoch: 3 }, { songTime: 4.02, epoch: 3 })).toBe(true);
    expect(beganAnew({ songTime: 4, epoch: 3 }, { songTime: 4.1, epoch: 3 })).toBe(false);
    expect(beganAnew({ songTime: 7, epoch: 3 }, { songTime: 4, epoch: 4 }), "somebody went back").toBe(false);
    expect(beganAnew({ songTime: 4, epoch: 3 }, { songTime: 4, epoch: 3 }), "it is counted in").toBe(false);
    expect(beganAnew(null, { songTime: 4, epoch: 3 })).toBe(false);
  });

  it("are faster by their step, up to the last rate", () => {
    let rate = 0.6;
    const rates: number[] = [];
    while (rate < 0.8) rates.push((rate = nextRound(rate, 0.8, 0.07)));
    expect(rates).toEqual([0.67, 0.74, 0.8]);
  });
});
