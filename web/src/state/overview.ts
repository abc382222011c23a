import type { WireNote } from "../generated/protocol";

/** A run of the part's notes between two rests, seconds. */
export interface Phrase {
  readonly start: number;
  readonly end: number;
}

/** A rest that lets the player breathe and the eye see a phrase's end. */
const REST_BEATS = 0.9;
const LONGEST_PHRASE_S = 30;

/** The phrases of a part as the overview shows them: its notes, grouped at their rests. Notes come by onset. */
export function phrasesOf(notes: readonly WireNote[]): Phrase[] {
  const phrases: { start: number; end: number; endBeats: number }[] = [];
  for (const note of notes) {
    const end = note.onset_s + note.duration_s;
    const endBeats = note.onset_beats + note.duration_beats;
    const open = phrases.at(-1);
    const joins = open !== undefined && note.onset_beats - open.endBeats < REST_BEATS;
    if (open === undefined || !joins || note.onset_s - open.start > LONGEST_PHRASE_S) {
      phrases.push({ start: note.onset_s, end, endBeats });
    } else {
      open.end = Math.max(open.end, end);
      open.endBeats = Math.max(open.endBeats, endBeats);
    }
  }
  return phrases.map(({ start, end }) => ({ start, end }));
}

/** Lowest and highest sounding pitch, MIDI numbers, at least an octave apart so that a few notes do not fill the height. */
export function pitchRange(notes: readonly WireNote[]): [low: number, high: number] {
  let low = Infinity;
  let high = -Infinity;
  for (const { sounding_pitch: pitch } of notes) {
    low = Math.min(low, pitch);
    high = Math.max(high, pitch);
  }
  if (low > high) return [54, 78];
  const missing = Math.max(12 - (high - low), 0) / 2;
  return [low - missing, high + missing];
}

const BAR_STEPS = [1, 2, 4, 8, 16, 32, 64, 128, 256];

/** Every how many bars a number stands, so that two of them are at least `gap` pixels apart. */
export function barNumberStep(bars: number, width: number, gap: number): number {
  const wanted = (bars * gap) / Math.max(width, 1);
  return BAR_STEPS.find((step) => step >= wanted) ?? 512;
}
