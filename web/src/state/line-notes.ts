import type { WireNote } from "../generated/protocol";

type Sounding = Pick<WireNote, "onset_s" | "duration_s"> & {
  readonly valves: readonly number[] | null;
  readonly fingering?: { readonly type: string } | null;
};

/** Whether a note is played: on valves, or as another kind of instrument plays it. */
export function isPlayed({ valves, fingering = null }: Pick<Sounding, "valves" | "fingering">): boolean {
  return valves !== null || fingering !== null;
}

/**
 * Of a part's notes those that its player plays, one at a time: no chord's other notes, and none that the instrument
 * lacks. One that is held on under the next ends where that begins, as it is played.
 *
 * @param notes by onset
 */
export function lineNotes<T extends Sounding>(notes: readonly T[]): readonly T[] {
  const played = notes.filter(isPlayed);
  return played.map((note, index) => {
    // Hits at one time are of several limbs.
    if (note.fingering?.type === "strike") return note;
    const room = (played[index + 1]?.onset_s ?? Infinity) - note.onset_s;
    return note.duration_s > room ? { ...note, duration_s: room } : note;
  });
}

/**
 * A cast's notes as blocks show them: each player's line as it is played, and the rest, which is not lit, as it is
 * written.
 */
export function blockNotes<T extends Sounding & { readonly player: number | null }>(notes: readonly T[]): readonly T[] {
  const players = [...new Set(notes.map(({ player }) => player))];
  const lines = players.flatMap((one) => lineNotes(notes.filter(({ player }) => player === one)));
  return [...lines, ...notes.filter((note) => !isPlayed(note))];
}
