/** Height on the staff: naturals on lines and in spaces, sharps and flats halfway between. */

/** Diatonic steps of each semitone above C. */
const STEPS = [0, 0.5, 1, 1.5, 2, 3, 3.5, 4, 4.5, 5, 5.5, 6] as const;

/** The bottom line of the treble staff, E4 (64). */
const BOTTOM_LINE = 7 * 5 + 2;

/** Steps of the five lines. */
export const STAFF_LINES = [0, 2, 4, 6, 8] as const;

/**
 * Height of a written pitch on the treble staff.
 *
 * @param pitch written MIDI number.
 * @returns diatonic steps above the bottom line: 0 is E4, 8 the top line F5, -2 the ledger line of C4.
 */
export function staffStep(pitch: number): number {
  const semitone = ((pitch % 12) + 12) % 12;
  return 7 * Math.floor(pitch / 12) + (STEPS[semitone] ?? 0) - BOTTOM_LINE;
}

/** Where each piece of a drum kit has its place, as a drummer reads it: feet below, cymbals above. */
const DRUM_STEPS: Readonly<Record<string, number>> = {
  kick: 1,
  tom_floor: 3,
  cowbell: 4,
  snare: 5,
  tom_mid: 6,
  tom_high: 7,
  ride: 8,
  hi_hat: 9,
  crash_right: 10,
  crash_left: 11,
  splash: 12,
  china: 13,
};

/** The pieces that have a place, in the order in which a stage counts them. */
export const DRUM_PIECES: readonly string[] = Object.keys(DRUM_STEPS);

/** Of the hi-hat where the foot plays it. */
const HI_HAT_FOOT = -1;

/** Height of a hit on the drum staff, in the same steps. */
export function drumStep(piece: string, byFoot: boolean): number {
  return byFoot && piece === "hi_hat" ? HI_HAT_FOOT : (DRUM_STEPS[piece] ?? 5);
}

/** Steps of the ledger lines that a note at `step` needs, from the staff outward. */
export function ledgerSteps(step: number): number[] {
  const lines: number[] = [];
  for (let line = -2; line >= step - 0.5; line -= 2) lines.push(line);
  for (let line = 10; line <= step + 0.5; line += 2) lines.push(line);
  return lines;
}
