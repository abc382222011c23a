import type { PartChoice } from "../generated/protocol";
import { serverWords } from "../words";

/** A figure's or a seat's name as it is read: `far left` as `Far left`. */
export function shownName(name: string, kind: "player" | "seat" = "player"): string {
  return serverWords(kind, name, name.charAt(0).toUpperCase() + name.slice(1).replaceAll(/[-_]/g, " "));
}

/** Reasons in words; how much each weighs is for those who read the API. */
export function inWords(reasons: PartChoice["reasons"]): string {
  return reasons.map((reason) => reason.replace(/ \([+−-][\d.]+\)$/, "")).join("; ");
}
