import type { PartSummary } from "../generated/protocol";

/** A part's name; where the file gives none, its number. */
export function partName(part: PartSummary): string {
  return part.name === "" ? `Part ${part.index + 1}` : part.name;
}
