import type { PartSummary } from "../generated/protocol";
import { told } from "../words/told/en";

/** A part's name; where the file gives none, its number. */
export function partName(part: PartSummary): string {
  return part.name === "" ? told.partNumber({ number: part.index + 1 }) : part.name;
}
