import { language } from "./language";
import { named } from "./server/en";

/** What the server names, told apart by what it is. */
export type Kind = "instrument" | "player" | "seat" | "mood" | "problem" | "piece" | "limb";

/** The message's name of something of the server's. */
function keyOf(kind: Kind, name: string): string {
  return `${kind}_${name.replace(/^urn:reina:problem:/, "").replaceAll(/[ -]/g, "_")}`;
}

/** Whether the page has words of its own for something of the server's. */
export function isNamed(kind: Kind, name: string): boolean {
  return keyOf(kind, name) in named;
}

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
  return (named as Readonly<Record<string, string>>)[keyOf(kind, name)] ?? english;
}
