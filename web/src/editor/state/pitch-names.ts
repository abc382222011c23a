import { fields } from "../../words/editor-fields/en";

/** Pitches by name, as people write them: B♭4, C5..G5. C4 is MIDI number 60. */

/** How pitches are read and called: the key that spells them, and what is written for what sounds. */
export interface PitchReading {
  /** Semitones from a pitch that sounds to the one that is written. */
  readonly above: number;
  /** Sharps of the key as it sounds; flats are negative. */
  readonly fifths: number;
  readonly minor: boolean;
}

/** Lowest and highest MIDI number, as they sound. */
export type PitchRange = readonly [low: number, high: number];

/** A pitch, or a range, that cannot be read; the message says what would be right. */
export class PitchError extends Error {
  override readonly name = "PitchError";
}

const HIGHEST = 127;
/** By fifths, from F: so sharps are added to a signature. */
const LETTERS = "FCGDAEB";
const SEMITONES: Readonly<Record<string, number>> = { C: 0, D: 2, E: 4, F: 5, G: 7, A: 9, B: 11 };
const ACCIDENTALS: Readonly<Record<string, number>> = { "♭": -1, b: -1, "♯": 1, "#": 1, "♮": 0 };
/** Names of two accidentals are never used: between F♭ and B♯, places on the line of fifths, where C is 0. */
const FLATTEST = -8;
const SHARPEST = 12;
/** More accidentals than these a key is not given. */
const MAX_FIFTHS = 6;
const NAME = /^([A-Ga-g])\s*([♭b]{0,2}|[♯#]{0,2}|♮)\s*(-?\d+)?$/;
const BETWEEN = /\s*(?:\.{2,}|…|\bto\b|(?<=\d)\s*[-–—])\s*/;

/** What a pitch that sounds is called: in the key as it is, else by the name nearest to the middle of its scale. */
export function pitchName(sounding: number, { above, fifths, minor }: PitchReading): string {
  const pitch = sounding + above;
  const middle = simplest(fifths + fifthsOf(above)) + (minor ? 3 : 2);
  let name = Infinity;
  for (let place = FLATTEST; place <= SHARPEST; place += 1) {
    const fits = (((7 * place - pitch) % 12) + 12) % 12 === 0;
    if (fits && Math.abs(place - middle) < Math.abs(name - middle)) name = place;
  }
  const alteration = Math.floor((name + 1) / 7);
  const letter = LETTERS[(((name + 1) % 7) + 7) % 7] ?? "";
  const accidental = alteration < 0 ? "♭" : alteration > 0 ? "♯" : "";
  return `${letter}${accidental}${Math.floor((pitch - alteration) / 12) - 1}`;
}

/** A range as it is written: one pitch, two with dots between, and nothing for all that there are. */
export function rangeName([low, high]: PitchRange, reading: PitchReading): string {
  if (low <= 0 && high >= HIGHEST) return "";
  if (low === high) return pitchName(low, reading);
  if (low <= 0) return `..${pitchName(high, reading)}`;
  return high >= HIGHEST ? `${pitchName(low, reading)}..` : `${pitchName(low, reading)}..${pitchName(high, reading)}`;
}

/**
 * The range that was written: a pitch or two, each a name or a MIDI number as it sounds; null for all.
 *
 * @throws PitchError if it is none.
 */
export function readRange(text: string, reading: PitchReading): PitchRange | null {
  const [first = "", second, more] = text.trim().split(BETWEEN);
  if (first === "" && (second ?? "") === "") return null;
  if (more !== undefined) throw new PitchError(fields.moreEnds({ text: text.trim() }));
  const low = first === "" ? 0 : readPitch(first, reading);
  const high = second === undefined ? low : second === "" ? HIGHEST : readPitch(second, reading);
  if (low > high) {
    throw new PitchError(fields.higher({ low: first, high: second ?? "" }));
  }
  return [low, high];
}

function readPitch(text: string, reading: PitchReading): number {
  if (/^\d+$/.test(text)) {
    const number = Number(text);
    if (number > HIGHEST) throw new PitchError(fields.beyondNumber({ most: HIGHEST, text }));
    return number;
  }
  const [, letter = "", accidentals = "", octave] = NAME.exec(text) ?? [];
  if (letter === "") {
    throw new PitchError(fields.noPitch({ text }));
  }
  const called = letter.toUpperCase() + accidentals.replaceAll("b", "♭").replaceAll("#", "♯");
  if (octave === undefined) throw new PitchError(fields.everyOctave({ name: called }));
  const altered = Array.from(accidentals).reduce((sum, each) => sum + (ACCIDENTALS[each] ?? 0), 0);
  const written = (Number(octave) + 1) * 12 + (SEMITONES[letter.toUpperCase()] ?? 0) + altered;
  const sounding = written - reading.above;
  if (sounding < 0 || sounding > HIGHEST) {
    const [lowest, highest] = [pitchName(0, reading), pitchName(HIGHEST, reading)];
    throw new PitchError(fields.beyondMidi({ name: called + octave, lowest, highest }));
  }
  return sounding;
}

/** The same key with six sharps or flats at most. */
function simplest(fifths: number): number {
  if (fifths > MAX_FIFTHS) return simplest(fifths - 12);
  return fifths < -MAX_FIFTHS ? simplest(fifths + 12) : fifths;
}

/** By how many fifths an interval of semitones moves a key, -5 to 6. */
function fifthsOf(semitones: number): number {
  return ((((7 * semitones + 5) % 12) + 12) % 12) - 5;
}
