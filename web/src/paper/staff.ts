/** A staff's space and a stem, in the staff's own units. */
export const SPACE = 10;
export const STEM = 3.5 * SPACE;

const LETTERS = "CDEFGAB";

/** How many letters a pitch lies above C0. */
export function staffPlace(pitch: { letter: string; octave: number }): number {
  return pitch.octave * 7 + LETTERS.indexOf(pitch.letter);
}
