import type { WireNote } from "../generated/protocol";

/**
 * Of a part's notes those that its player plays, one at a time: no chord's other notes, and none that the instrument
 * lacks. One that is held on under the next ends where that begins, as it is played.
 *
 * @param notes by onset
 */
export function lineNotes(notes: readonly WireNote[]): readonly WireNote[] {
  const played = notes.filter(({ valves }) => valves !== null);
  return played.map((note, index) => {
    const room = (played[index + 1]?.onset_s ?? Infinity) - note.onset_s;
    return note.duration_s > room ? { ...note, duration_s: room } : note;
  });
}

/** A part's notes as blocks show them: the line as it is played, and the rest, which is not lit, as it is written. */
export function blockNotes(notes: readonly WireNote[]): readonly WireNote[] {
  return [...lineNotes(notes), ...notes.filter(({ valves }) => valves === null)];
}
