import { describe, expect, it } from "vitest";
import { firstFrom, KeyTimes, nearest } from "./key-times";
import type { ShowTrack } from "./show-document";
import { TimeAxis } from "./time-axis";

const axis = new TimeAxis({ tempi: [{ onset_beats: 0, onset_s: 0, bpm: 60 }], bar_lines_s: [0, 4, 8] });
const track: ShowTrack = {
  parameter: "a",
  keyframes: [0, 0.5, 2].map((time, index) => ({ key: `k${index}`, time, value: 0 })),
};

describe("song times of keyframes", () => {
  it("follow the track's unit, or the show's", () => {
    expect([...new KeyTimes(axis, "bars").of(track)]).toEqual([0, 2, 8]);
    expect([...new KeyTimes(axis, "bars").of({ ...track, time: "seconds" })]).toEqual([0, 0.5, 2]);
  });

  it("are reckoned once for a track", () => {
    const times = new KeyTimes(axis, "bars");
    expect(times.of(track)).toBe(times.of(track));
  });

  it("are found by halving", () => {
    const times = new Float64Array([1, 2, 4]);
    expect([0, 1, 1.5, 4, 5].map((time) => firstFrom(times, time))).toEqual([0, 0, 1, 2, 3]);
    expect([0, 1.4, 1.6, 9].map((time) => nearest(times, time))).toEqual([0, 0, 1, 2]);
    expect(nearest(new Float64Array(), 1)).toBe(-1);
  });
});
