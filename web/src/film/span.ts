/** Which frames a film shows. */

import { film } from "../words/film/en";

/** Song times, seconds. */
export interface SongSpan {
  readonly start: number;
  readonly end: number;
}

/** Frames `first` … `end` − 1 of the grid k / fps. */
export interface FrameSpan {
  readonly first: number;
  readonly end: number;
  readonly fps: number;
}

/** The server counts a frame as within a span up to this share of a frame before it. */
const GRID_TOLERANCE = 1e-6;

/** The frames k with start ≤ k / fps < end, as the server counts them; at least one. */
export function framesOf({ start, end }: SongSpan, fps: number): FrameSpan {
  const first = Math.max(0, Math.ceil(start * fps - GRID_TOLERANCE));
  return { first, end: Math.max(first + 1, Math.ceil(end * fps - GRID_TOLERANCE)), fps };
}

/** How many frames a span has. */
export function countOf({ first, end }: FrameSpan): number {
  return end - first;
}

/** A span cut into pieces of at most `most` frames, in order. */
export function piecesOf({ first, end, fps }: FrameSpan, most: number): FrameSpan[] {
  const count = Math.ceil((end - first) / most);
  return Array.from({ length: count }, (_, place) => {
    const begin = first + place * most;
    return { first: begin, end: Math.min(begin + most, end), fps };
  });
}

/** What is wrong with a span in a song of this length, or null. */
export function faultOf({ start, end }: SongSpan, duration: number): string | null {
  if (!Number.isFinite(start) || !Number.isFinite(end)) return film.writeTimes;
  if (start < 0) return film.beginsTooEarly;
  if (start >= duration) return film.beginsTooLate;
  if (end <= start) return film.endsTooEarly;
  return null;
}

/** Seconds of a time as it is written, `1:02.5` or `62.5`; NaN where it is none. */
export function secondsOf(text: string): number {
  const found = /^\s*(?:(\d{1,4}):)?(\d{1,6}(?:[.,]\d*)?)\s*$/.exec(text);
  if (found === null) return Number.NaN;
  const [, minutes = "0", seconds = ""] = found;
  return 60 * Number(minutes) + Number(seconds.replace(",", "."));
}
