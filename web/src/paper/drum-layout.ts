import type { PartEntry, PartMeasure, WrittenPart } from "../generated/protocol";
import { SPACE, STEM, staffPlace } from "./staff";

/** Above a stem: an accent, or the sign of an open hi-hat. */
const MARK = 14;
/** By how much a beam, or a tuplet's number, may lie farther out than the stems. */
const BEAM = 8;
const TUPLET = 16;

/** Whether a measure is of two voices, as drums are. */
export function isInVoices(measure: PartMeasure): boolean {
  return measure.entries.some(({ voice }) => voice !== null);
}

/** How much room two voices need: that of the shortest that goes on at each time. */
export function voicesWidth(measure: PartMeasure): number {
  const begins = [...new Set(measure.entries.map(({ begin_ticks }) => begin_ticks))].sort((a, b) => a - b);
  return begins.reduce((sum, begin, at) => {
    const ticks = (begins[at + 1] ?? measure.ticks) - begin;
    const here = measure.entries.filter(({ begin_ticks }) => begin_ticks === begin);
    const graces = Math.max(...here.map((entry) => entry.graces.length));
    const ghosts = here.some(({ heads }) => heads.some(({ is_ghost }) => is_ghost)) ? 10 : 0;
    return sum + Math.max(12 + 8.5 * Math.log2(1 + ticks / 3), 25) + 13 * graces + ghosts;
  }, 0);
}

/** How far hands' notes, with their stems and signs, reach above the staff. */
export function drumsHeight(entries: readonly PartEntry[], staff: { top: number }): number {
  const heights = entries
    .filter(({ voice, heads }) => voice === "hands" && heads.length > 0)
    .map(({ heads, tuplet }) => {
      const top = (Math.max(...heads.map(staffPlace)) - staff.top) * (SPACE / 2);
      const marks = heads.filter(({ mark }) => mark !== null).length;
      return top + STEM + BEAM + MARK * marks + (tuplet === null ? 0 : TUPLET);
    });
  // Above the staff there is room for a bar's number already.
  return Math.max(0, ...heights.map((height) => height - SPACE));
}

/** How far feet's notes, with their stems, reach below the staff. */
export function drumsDepth(entries: readonly PartEntry[], staff: { bottom: number }): number {
  const depths = entries
    .filter(({ voice, heads }) => voice === "feet" && heads.length > 0)
    .map(({ heads, tuplet }) => {
      const lowest = (staff.bottom - Math.min(...heads.map(staffPlace))) * (SPACE / 2);
      const marks = heads.some(({ mark }) => mark !== null) ? MARK : 0;
      return lowest + STEM + BEAM + marks + (tuplet === null ? 0 : TUPLET);
    });
  return Math.max(0, ...depths);
}

/** Of each hit of a drum part the one that its entry on paper is known by: it stands there, or is its grace note. */
export function entriesOfHits(part: WrittenPart): readonly number[] {
  const entryOf = new Map<number, number>();
  for (const entry of part.measures.flatMap(({ entries }) => entries)) {
    if (entry.note === null) continue;
    for (const { note } of [...entry.heads, ...entry.graces]) entryOf.set(note, entry.note);
  }
  return part.notes.map((_, index) => entryOf.get(index) ?? index);
}
