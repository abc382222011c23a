import type { GraceNote, StaveNote } from "vexflow/bravura";
import type { PartEntry } from "../generated/protocol";

export const DURATIONS: Readonly<Record<number, string>> = {
  1: "w",
  2: "h",
  4: "q",
  8: "8",
  16: "16",
  32: "32",
  64: "64",
};
/** Of beams. */
export const MAX_SLOPE = 0.14;

/** A note as it is drawn, with what it is tied to. */
export interface Drawn {
  readonly entry: PartEntry;
  readonly note: StaveNote;
  /** Its grace notes, as many as `entry.graces`. */
  readonly graces: readonly GraceNote[];
}

/** Neighbours of one number, group by group. */
export function groupsOf<T>(items: readonly T[], number: (item: T) => number | null): T[][] {
  const groups = new Map<number, T[]>();
  for (const item of items) {
    const of = number(item);
    if (of !== null) groups.set(of, [...(groups.get(of) ?? []), item]);
  }
  return [...groups.values()];
}
