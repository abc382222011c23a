import { describe, expect, it } from "vitest";
import { copied, pasted } from "./clipboard";
import { KeyTimes } from "./key-times";
import type { ShowDocument, ShowTrack } from "./show-document";
import { TimeAxis } from "./time-axis";

/** 4/4 at 120, from beat 8 on at 60. */
const axis = new TimeAxis({
  tempi: [
    { onset_beats: 0, onset_s: 0, bpm: 120 },
    { onset_beats: 8, onset_s: 4, bpm: 60 },
  ],
  bar_lines_s: [0, 2, 4, 8, 12],
});
const track: ShowTrack = {
  parameter: "a",
  keyframes: [
    { key: "k1", time: 1, value: 1, interpolation: "step" },
    { key: "k2", time: 1.5, value: 2, interpolation: "quad_in" },
  ],
};
const document: ShowDocument = { version: 1, title: "", time: "bars", tracks: [track] };
const times = new KeyTimes(axis, "bars");
const chosen = track.keyframes.map((keyframe) => ({ track, keyframe }));

describe("copy and paste", () => {
  it("keeps distances in beats where the tempo is another, and everything but key and time", () => {
    const taken = copied(axis, times, chosen);
    if (taken === null) throw new Error("nothing was copied");
    const { edits, keys } = pasted(axis, times, document, taken, 4);
    expect(edits).toMatchObject([
      { edit: "add_keyframe", parameter: "a", keyframe: { time: 2, value: 1, interpolation: "step" } },
      { edit: "add_keyframe", parameter: "a", keyframe: { time: 2.5, value: 2, interpolation: "quad_in" } },
    ]);
    expect(new Set(keys.map(([, key]) => key)).size).toBe(2);
  });

  it("puts onto another track what comes from one, in that track's unit, and takes the place of what stands there", () => {
    const taken = copied(axis, times, chosen.slice(0, 1));
    if (taken === null) throw new Error("nothing was copied");
    const other: ShowTrack = { parameter: "b", time: "seconds", keyframes: [{ key: "old", time: 4, value: 9 }] };
    const { edits } = pasted(axis, times, { ...document, tracks: [track, other] }, taken, 4, "b");
    expect(edits).toMatchObject([
      { edit: "remove_keyframe", parameter: "b", key: "old" },
      { edit: "add_keyframe", parameter: "b", keyframe: { time: 4, value: 1 } },
    ]);
  });

  it("has nothing of nothing", () => {
    expect(copied(axis, times, [])).toBeNull();
  });
});
