import { describe, expect, it } from "vitest";
import { snapped, type Snap } from "./snapping";
import { TimeAxis } from "./time-axis";

const score = { tempi: [{ onset_beats: 0, onset_s: 0, bpm: 60 }], bar_lines_s: [0, 4, 8] };
const places = { axis: new TimeAxis(score), score, keys: [new Float64Array([1.3, 2.52])], markers: [3.4], fps: 60 };
const to = (time: number, reach: number, ...on: Snap[]) => snapped(time, reach, new Set(on), places);

describe("snapping", () => {
  it("goes to the nearest of what is on, and only within reach", () => {
    expect(to(4.1, 0.2, "bars")).toBe(4);
    expect(to(4.3, 0.2, "bars")).toBe(4.3);
    expect(to(2.51, 0.2, "beats", "keys")).toBe(2.52);
    expect(to(3.38, 0.2, "markers")).toBe(3.4);
    expect(to(3.38, 0.2)).toBe(3.38);
  });

  it("knows parts of a beat once they are apart on screen", () => {
    expect(to(2.27, 0.05, "beats")).toBe(2.25);
    expect(to(2.27, 0.3, "beats")).toBe(2);
  });

  it("takes a frame where nothing else is near", () => {
    expect(to(2.501, 0.05, "frames")).toBeCloseTo(2.5, 9);
    expect(to(3.99, 0.05, "frames", "bars")).toBe(4);
  });
});
