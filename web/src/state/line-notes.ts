import type { WireNote } from "../generated/protocol";

/** Of a part's notes those that are heard from its player: no chord's other notes, and none that the instrument lacks. */
export function lineNotes(notes: readonly WireNote[]): readonly WireNote[] {
  return notes.filter(({ valves }) => valves !== null);
}
