import type { ChosenKey } from "./selection.svelte";
import type { KeyTimes } from "./key-times";
import type { TimeAxis } from "./time-axis";

/** Where chosen keyframes begin and end, song time, seconds. */
export interface Span {
  readonly start: number;
  readonly end: number;
}

/** The span of keyframes; null for none. */
export function spanOf(axis: TimeAxis, times: KeyTimes, keys: readonly ChosenKey[]): Span | null {
  let start = Infinity;
  let end = -Infinity;
  for (const { track, keyframe } of keys) {
    const at = axis.toSongTime(times.unitOf(track), keyframe.time);
    start = Math.min(start, at);
    end = Math.max(end, at);
  }
  return start > end ? null : { start, end };
}

/**
 * A move of keyframes, in quarter notes, so that what stood on a beat stands on one again where the tempo is another:
 * a time comes to about + factor · (time - about) + by.
 */
export interface Retiming {
  readonly about: number;
  readonly factor: number;
  readonly by: number;
}

/** Keyframes may be stretched to this share of their span, and not nearer to each other. */
const MIN_STRETCH = 0.01;

/** Take what is at `from` to `to`, song times, seconds, and everything with it. */
export function movedBy(axis: TimeAxis, from: number, to: number): Retiming {
  return { about: 0, factor: 1, by: axis.beatsAt(to) - axis.beatsAt(from) };
}

/** Stretch about `held`, so that what was at `from` comes to `to`; all song times, seconds. */
export function stretched(axis: TimeAxis, held: number, from: number, to: number): Retiming {
  const about = axis.beatsAt(held);
  const length = axis.beatsAt(from) - about;
  const factor = length === 0 ? 1 : Math.max((axis.beatsAt(to) - about) / length, MIN_STRETCH);
  return { about, factor, by: 0 };
}

/** Where a move takes a song time, seconds. */
export function placed(axis: TimeAxis, { about, factor, by }: Retiming, songTime: number): number {
  return axis.secondsAt(about + factor * (axis.beatsAt(songTime) - about) + by);
}
