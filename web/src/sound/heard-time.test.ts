import { describe, expect, it } from "vitest";
import { heardContextTime, type AudioClockReading } from "./heard-time";

const reading: AudioClockReading = {
  pageTime: 20,
  currentTime: 5,
  outputLatency: 0.04,
  baseLatency: 0.01,
  outputContextTime: 4.9,
  outputPageTime: 19.95,
};

describe("heardContextTime", () => {
  it("carries the output timestamp forward to the moment of the reading", () => {
    expect(heardContextTime(reading)).toBeCloseTo(4.95, 9);
  });

  it.each([
    ["none yet", { outputContextTime: 0, outputPageTime: 0 }],
    ["one from long ago", { outputContextTime: 1, outputPageTime: 19.9 }],
    ["one from the future", { outputContextTime: 9, outputPageTime: 19.9 }],
    ["none at all", { outputContextTime: undefined, outputPageTime: undefined }],
  ])("falls back to the reported latency with %s", (_, change) => {
    expect(heardContextTime({ ...reading, ...change })).toBeCloseTo(4.96, 9);
  });

  it("discards absurd latencies", () => {
    const without = { ...reading, outputContextTime: undefined };
    expect(heardContextTime({ ...without, outputLatency: 3600 })).toBeCloseTo(4.99, 9);
    expect(heardContextTime({ ...without, outputLatency: NaN, baseLatency: -1 })).toBe(5);
  });
});
