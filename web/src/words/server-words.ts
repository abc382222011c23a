import { language } from "./language";
import { named } from "./server/en";

/** What the server names, told apart by what it is. */
export type Kind = "instrument" | "player" | "seat" | "mood" | "problem" | "piece" | "limb";

/** A piece of a drum kit. */
export function pieceName(piece: string): string {
  return (named as Readonly<Record<string, string>>)[`piece_${piece}`] ?? piece;
}

/** A drummer's hand or foot. */
export function limbName(side: "left" | "right", isHand: boolean): string {
  return named[`limb_${side}_${isHand ? "hand" : "foot"}`];
}

/**
 * A name or a title of the server's in the language that is shown.
 *
 * @param kind what it names
 * @param name its stable name: `far left`, or a problem's type
 * @param english the server's own words, which stand where the page has no others: for what plugins bring
 */
export function serverWords(kind: Kind, name: string, english: string): string {
  // A figure has no title of its own: the server has only the name of its rig.
  if (language() === "en" && kind !== "player") return english;
  const key = `${kind}_${name.replace(/^urn:reina:problem:/, "").replaceAll(/[ -]/g, "_")}`;
  return (named as Readonly<Record<string, string>>)[key] ?? english;
}
