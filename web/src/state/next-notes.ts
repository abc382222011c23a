import type { WireNote } from "../generated/protocol";

/** Two times that are meant to be the same may differ by what floating point leaves, seconds. */
const SAME_S = 1e-6;

/** Where a moment lies among notes. */
export interface Place {
  /** Index of the note that sounds, or else of the next one; how many notes there are after the last. */
  readonly first: number;
  /** Whether that note sounds already. */
  readonly sounds: boolean;
}

/**
 * Where a song time lies among the notes of a line.
 *
 * @param notes by onset, none inside another.
 * @param songTime seconds.
 */
export function placeIn(notes: readonly Pick<WireNote, "onset_s" | "duration_s">[], songTime: number): Place {
  const now = songTime + SAME_S;
  let first = 0;
  let end = notes.length;
  while (first < end) {
    const middle = (first + end) >> 1;
    const note = notes[middle];
    if (note !== undefined && note.onset_s + note.duration_s <= now) first = middle + 1;
    else end = middle;
  }
  return { first, sounds: (notes[first]?.onset_s ?? Infinity) <= now };
}
