import type { WireNote } from "../generated/protocol";

/** Two times that are meant to be the same may differ by what floating point leaves, seconds. */
export const SAME_S = 1e-6;

/** Where a moment lies among notes. */
export interface Place {
  /** Of the note that sounds, or of the first of several; or else of the next one; how many there are after the last. */
  readonly first: number;
  /** Whether that note sounds already. */
  readonly sounds: boolean;
}

/**
 * Where a song time lies among the notes of a line. What is struck at once has one place; what rings on under the next
 * stroke, as a crash does, is past.
 *
 * @param notes by onset.
 * @param songTime seconds.
 */
export function placeIn(notes: readonly Pick<WireNote, "onset_s" | "duration_s">[], songTime: number): Place {
  const now = songTime + SAME_S;
  let next = 0;
  let end = notes.length;
  while (next < end) {
    const middle = (next + end) >> 1;
    if ((notes[middle]?.onset_s ?? Infinity) <= now) next = middle + 1;
    else end = middle;
  }
  const begun = (notes[next - 1]?.onset_s ?? Infinity) - SAME_S;
  let first = next;
  while ((notes[first - 1]?.onset_s ?? -Infinity) >= begun) first--;
  const sounds = notes.slice(first, next).some(({ onset_s, duration_s }) => onset_s + duration_s > now);
  return { first: sounds ? first : next, sounds };
}
