/** How black keys are called: by their sharps or by their flats, as the key of the music has them. */
export type Spelling = "sharps" | "flats" | "mixed";

const NAMES: Readonly<Record<Spelling, readonly string[]>> = {
  sharps: ["C", "C♯", "D", "D♯", "E", "F", "F♯", "G", "G♯", "A", "A♯", "B"],
  flats: ["C", "D♭", "D", "E♭", "E", "F", "G♭", "G", "A♭", "A", "B♭", "B"],
  mixed: ["C", "C♯", "D", "E♭", "E", "F", "F♯", "G", "A♭", "A", "B♭", "B"],
};

/** Pitch classes of C major; a key one fifth up is these seven semitones higher. */
const SCALE = [0, 2, 4, 5, 7, 9, 11];
const FIFTHS = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6];

/** The spelling that suits pitches (MIDI numbers): that of the major scale which holds most of them. */
export function spellingOf(pitches: readonly number[]): Spelling {
  const counts = new Array<number>(12).fill(0);
  for (const pitch of pitches) counts[pitch % 12] = (counts[pitch % 12] ?? 0) + 1;
  let best = 0;
  let most = -1;
  for (const fifths of FIFTHS) {
    const held = SCALE.reduce((sum, step) => sum + (counts[(step + 7 * fifths + 84) % 12] ?? 0), 0);
    if (held > most) [best, most] = [fifths, held];
  }
  if (best === 0) return "mixed";
  return best > 0 ? "sharps" : "flats";
}

/** A pitch's name with its octave, middle C (MIDI 60) being C4: `B♭4`. */
export function pitchName(pitch: number, spelling: Spelling = "mixed"): string {
  return `${NAMES[spelling][pitch % 12] ?? ""}${Math.floor(pitch / 12) - 1}`;
}
