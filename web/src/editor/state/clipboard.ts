import type { Edit } from "./edits";
import type { KeyTimes } from "./key-times";
import { byTrack, type ChosenKey } from "./selection.svelte";
import { trackOf, type ShowDocument, type ShowKeyframe, type TimeUnit } from "./show-document";
import type { TimeAxis } from "./time-axis";

/** Keyframes that were copied, with where they stood. */
export interface Copied {
  readonly tracks: readonly CopiedTrack[];
  /** Song time of the first, seconds. */
  readonly from: number;
  readonly count: number;
}

interface CopiedTrack {
  readonly parameter: string;
  readonly unit: TimeUnit;
  readonly keyframes: readonly ShowKeyframe[];
}

/** What was pasted: the edits, and which keyframes they make. */
export interface Pasted {
  readonly edits: readonly Edit[];
  readonly keys: readonly (readonly [path: string, key: string])[];
}

export function copied(axis: TimeAxis, times: KeyTimes, keys: readonly ChosenKey[]): Copied | null {
  if (keys.length === 0) return null;
  const tracks = [...byTrack(keys)].map(([track, keyframes]) => ({
    parameter: track.parameter,
    unit: times.unitOf(track),
    keyframes,
  }));
  const all = tracks.flatMap(({ unit, keyframes }) => keyframes.map(({ time }) => axis.toSongTime(unit, time)));
  return { tracks, from: Math.min(...all), count: keys.length };
}

/**
 * Put copied keyframes so that the first stands at `at`, song time, seconds; distances are kept in beats.
 *
 * @param onto the track that takes them in place of the one that they came from, where they came from one.
 */
export function pasted(
  axis: TimeAxis,
  times: KeyTimes,
  document: ShowDocument,
  from: Copied,
  at: number,
  onto: string | null = null,
): Pasted {
  const beats = axis.beatsAt(at) - axis.beatsAt(from.from);
  const edits: Edit[] = [];
  const keys: [string, string][] = [];
  for (const { parameter: source, unit, keyframes } of from.tracks) {
    const parameter = from.tracks.length === 1 && onto !== null ? onto : source;
    const track = trackOf(document, parameter);
    const into = track === null ? document.time : times.unitOf(track);
    for (const keyframe of keyframes) {
      const songTime = axis.secondsAt(axis.beatsAt(axis.toSongTime(unit, keyframe.time)) + beats);
      const time = axis.toTrackTime(into, songTime);
      const there = track?.keyframes.find((each) => each.time === time);
      if (there !== undefined) edits.push({ edit: "remove_keyframe", parameter, key: there.key });
      const key = freshKey();
      edits.push({ edit: "add_keyframe", parameter, keyframe: { ...keyframe, key, time } });
      keys.push([parameter, key]);
    }
  }
  return { edits, keys };
}

/** A key that no keyframe has, whoever else adds one at the same time. */
export function freshKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(6));
  return `k${[...bytes].map((byte) => byte.toString(36).padStart(2, "0")).join("")}`;
}
