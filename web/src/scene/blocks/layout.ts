/** The score as columns of numbers for the graphics card: built once, then only scrolled. */

import type { ScoreNote, ScoreView } from "../score";
import { ledgerSteps, staffStep } from "./staff";

/** Notes drawn with one call; what is out of sight is left out by whole chunks. */
export const CHUNK_NOTES = 64;

/** Valves of a note that cannot be played. */
export const UNPLAYABLE = -1;

export interface Chunk {
  /** Seconds that the chunk's blocks and lines cover. */
  readonly startS: number;
  readonly endS: number;
  /** onset s, duration s, staff step, valve mask of each note. */
  readonly notes: Float32Array<ArrayBuffer>;
  /** start s, end s, start step, end step of each ledger and bar line. */
  readonly lines: Float32Array<ArrayBuffer>;
}

/** Bit v − 1 for each valve v that is down; 0 is open. */
export function valveMask(valves: readonly number[] | null): number {
  return valves === null ? UNPLAYABLE : valves.reduce((mask, valve) => mask | (1 << (valve - 1)), 0);
}

function ledgerLines(note: ScoreNote, step: number): number[] {
  return ledgerSteps(step).flatMap((line) => [note.onset_s, note.onset_s + note.duration_s, line, line]);
}

/**
 * Divide a score into chunks, by onset; every bar line belongs to the chunk in whose time it lies.
 */
export function layOut(score: ScoreView): Chunk[] {
  const notes = [...score.notes].sort((a, b) => a.onset_s - b.onset_s);
  const bars = [...score.bar_lines_s].sort((a, b) => a - b);
  const chunks: Chunk[] = [];
  let bar = 0;
  for (let first = 0; first < Math.max(notes.length, 1); first += CHUNK_NOTES) {
    const members = notes.slice(first, first + CHUNK_NOTES);
    const until = notes[first + CHUNK_NOTES]?.onset_s ?? Number.POSITIVE_INFINITY;
    const columns: number[] = [];
    const lines: number[] = [];
    let startS = members[0]?.onset_s ?? Number.POSITIVE_INFINITY;
    let endS = startS === Number.POSITIVE_INFINITY ? Number.NEGATIVE_INFINITY : startS;
    for (const note of members) {
      const step = staffStep(note.written_pitch);
      columns.push(note.onset_s, note.duration_s, step, valveMask(note.valves));
      lines.push(...ledgerLines(note, step));
      endS = Math.max(endS, note.onset_s + note.duration_s);
    }
    for (let at = bars[bar]; at !== undefined && at < until; at = bars[++bar]) {
      lines.push(at, at, 0, 8);
      startS = Math.min(startS, at);
      endS = Math.max(endS, at);
    }
    if (columns.length + lines.length > 0) {
      chunks.push({ startS, endS, notes: new Float32Array(columns), lines: new Float32Array(lines) });
    }
  }
  return chunks;
}
