import type { PartChoice } from "../generated/protocol";
import { language, serverWords } from "../words";

/** A figure's or a seat's name as it is read: `far left` as `Far left`. */
export function shownName(name: string, kind: "player" | "seat" = "player"): string {
  return serverWords(kind, name, name.charAt(0).toUpperCase() + name.slice(1).replaceAll(/[-_]/g, " "));
}

/** A figure's name within a sentence: `the trumpeter`. */
export function spokenName(name: string): string {
  const shown = shownName(name);
  return language() === "en" ? shown.toLowerCase() : shown;
}

/** Reasons in words; how much each weighs is for those who read the API. */
export function inWords(reasons: PartChoice["reasons"]): string {
  return reasons.map((reason) => reason.replace(/ \([+−-][\d.]+\)$/, "")).join("; ");
}
