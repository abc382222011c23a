import { describe, expect, it } from "vitest";
import { withEdits, withTracks } from "./edits";
import type { ShowDocument, ShowKeyframe } from "./show-document";
import { TimeAxis } from "./time-axis";

/** Two bars of 4/4 at 120, then 60. */
const axis = new TimeAxis({
  tempi: [
    { onset_beats: 0, onset_s: 0, bpm: 120 },
    { onset_beats: 8, onset_s: 4, bpm: 60 },
  ],
  bar_lines_s: [0, 2, 4, 8, 12],
});

const key = (key: string, time: number, more: Partial<ShowKeyframe> = {}): ShowKeyframe => ({
  key,
  time,
  value: time,
  interpolation: "linear",
  ...more,
});
const document: ShowDocument = {
  version: 1,
  title: "Evening",
  time: "bars",
  tracks: [
    { parameter: "a", keyframes: [key("k1", 0), key("k2", 1), key("k3", 2)] },
    { parameter: "b", time: "seconds", keyframes: [key("k1", 0), key("k2", 3)] },
  ],
};
const times = (shown: ShowDocument, path: string) =>
  shown.tracks.find(({ parameter }) => parameter === path)?.keyframes.map(({ key: name, time }) => `${name} ${time}`);
const move = (keyframes: Record<string, string[]>, by: number, about = 0, factor = 1) =>
  withEdits(document, [{ edit: "move_keyframes", keyframes, time: "beats", by, stretch: { about, factor } }], axis);

describe("edits, as the page shows them until the server has answered", () => {
  it("keep a track's keyframes in order, and leave the others as they are", () => {
    const edited = withEdits(document, [{ edit: "add_keyframe", parameter: "a", keyframe: key("k9", 0.5) }], axis);
    expect(times(edited, "a")).toEqual(["k1 0", "k9 0.5", "k2 1", "k3 2"]);
    expect(edited.tracks[1]).toBe(document.tracks[1]);
  });

  it("make a track of a first keyframe, and drop it with the last", () => {
    const added = withEdits(document, [{ edit: "add_keyframe", parameter: "c", keyframe: key("k1", 1) }], axis);
    expect(times(added, "c")).toEqual(["k1 1"]);
    const removed = withEdits(added, [{ edit: "remove_keyframe", parameter: "c", key: "k1" }], axis);
    expect(times(removed, "c")).toBeUndefined();
  });

  it("move in beats whatever a track counts in, over a change of tempo", () => {
    const moved = move({ a: ["k2", "k3"], b: ["k2"] }, 4);
    expect(times(moved, "a")).toEqual(["k1 0", "k2 2", "k3 3"]);
    // Beat 6 is second 3; beat 10 lies two beats of 60 behind second 4.
    expect(times(moved, "b")).toEqual(["k1 0", "k2 6"]);
  });

  it("let what stands in the way make room", () => {
    expect(times(move({ a: ["k1"] }, 4), "a")).toEqual(["k1 1", "k3 2"]);
  });

  it("stretch about one end, and make slopes flatter along", () => {
    const sloped: ShowDocument = {
      ...document,
      tracks: [{ parameter: "a", keyframes: [key("k1", 0), key("k2", 1, { in_tangent: 2 })] }],
    };
    const edit = {
      edit: "move_keyframes",
      keyframes: { a: ["k1", "k2"] },
      time: "beats",
      by: 0,
      stretch: { about: 0, factor: 2 },
    } as const;
    const stretched = withEdits(sloped, [edit], axis);
    expect(times(stretched, "a")).toEqual(["k1 0", "k2 2"]);
    expect(stretched.tracks[0]?.keyframes[1]?.in_tangent).toBe(1);
  });

  it("drop an interpolation's options with it, and keep slopes", () => {
    const bent = {
      ...document,
      tracks: [{ parameter: "a", keyframes: [key("k1", 0, { handles: [0, 0, 1, 1], out_tangent: 3 })] }],
    };
    const edited = withEdits(
      bent,
      [{ edit: "change_keyframe", parameter: "a", key: "k1", changes: { interpolation: "quad_in" } }],
      axis,
    );
    expect(edited.tracks[0]?.keyframes[0]).toEqual(key("k1", 0, { interpolation: "quad_in", out_tangent: 3 }));
  });

  it("leave keyframes where they are in the music when a track counts anew", () => {
    const edited = withEdits(
      document,
      [{ edit: "change_track", parameter: "a", changes: { time: "seconds", muted: null } }],
      axis,
    );
    expect(times(edited, "a")).toEqual(["k1 0", "k2 2", "k3 4"]);
  });

  it("are overwritten by what the server answers", () => {
    const answered = withTracks(
      document,
      [
        { parameter: "b", keyframes: [] },
        { parameter: "c", keyframes: [] },
      ],
      ["a"],
    );
    expect(answered.tracks.map(({ parameter }) => parameter)).toEqual(["b", "c"]);
  });
});
