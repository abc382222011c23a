/**
 * Colours of the players in the page's panels and strips, by their places in the cast, before the stage has said how it
 * colours their blocks. A number always stands beside them.
 */
const FIRST_INKS = ["#e8bf6e", "#5aa9f0", "#d9679b", "#a9ecc9"] as const;
const PAPER = "#f4efe6";

/** How far a colour has to change for the strips to be drawn anew: steps of 256. */
const STEP = 12;

/** A player's colour. */
export function playerInk(inks: readonly string[], player: number): string {
  return inks[player] ?? FIRST_INKS[player] ?? PAPER;
}

/** A shade of a colour, for what is still to come. */
export function softened(ink: string): string {
  return `${ink}a8`;
}

/** The colours that are shown, given those on the stage: as they were, until one is seen to be another. */
export function followedInks(shown: readonly string[], stage: readonly string[]): readonly string[] {
  const same = shown.length === stage.length && shown.every((ink, player) => isNear(ink, stage[player] ?? ""));
  return same ? shown : stage;
}

function isNear(a: string, b: string): boolean {
  return [1, 3, 5].every((at) => Math.abs(part(a, at) - part(b, at)) < STEP);
}

function part(ink: string, at: number): number {
  return Number.parseInt(ink.slice(at, at + 2), 16);
}
