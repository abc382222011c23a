/** The score as columns of numbers for the graphics card: built once, then only scrolled. */

import type { ScoreNote, ScoreView } from "../score";
import { DRUM_PIECES, drumStep, ledgerSteps, staffStep } from "./staff";

/** Notes drawn with one call; what is out of sight is left out by whole chunks. */
export const CHUNK_NOTES = 64;

/** Marks of a note that cannot be played. */
export const UNPLAYABLE = -1;

/** Marks of a hit; 1 is added for the right side, 2 for a hand. */
export const STRUCK = 16;

/** How long a hit is drawn at most, seconds: on drums the length of a note means nothing. */
const HIT_S = 0.11;

export interface Chunk {
  /** Seconds that the chunk's blocks and lines cover. */
  readonly startS: number;
  readonly endS: number;
  /** onset s, duration s, staff step, marks of each note. */
  readonly notes: Float32Array<ArrayBuffer>;
  /** Whose lane each note lies in. */
  readonly noteLanes: Float32Array<ArrayBuffer>;
  /** Which of `DRUM_PIECES` each hit strikes, from 1; 0 for notes that strike none. */
  readonly notePieces: Float32Array<ArrayBuffer>;
  /** start s, end s, start step, end step of each ledger and bar line. */
  readonly lines: Float32Array<ArrayBuffer>;
  readonly lineLanes: Float32Array<ArrayBuffer>;
}

/** Bit v − 1 for each valve v that is down; 0 is open. */
export function valveMask(valves: readonly number[] | null): number {
  return valves === null ? UNPLAYABLE : valves.reduce((mask, valve) => mask | (1 << (valve - 1)), 0);
}

/** Height on the staff, marks and length of a note's block. */
function blockOf(note: ScoreNote): { step: number; marks: number; duration: number } {
  const { fingering, duration_s: duration } = note;
  if (fingering?.type !== "strike") {
    return { step: staffStep(note.written_pitch), marks: valveMask(note.valves), duration };
  }
  const byHand = fingering.hand !== null;
  const right = (fingering.hand ?? fingering.foot) === "right";
  const marks = STRUCK + (right ? 1 : 0) + (byHand ? 2 : 0);
  return { step: drumStep(fingering.piece, !byHand), marks, duration: Math.min(duration, HIT_S) };
}

/** Four numbers a mark, and the lane of each. */
class Columns {
  readonly #values: number[] = [];
  readonly #lanes: number[] = [];

  add(lane: number, ...values: [number, number, number, number]): void {
    this.#values.push(...values);
    this.#lanes.push(lane);
  }

  get count(): number {
    return this.#lanes.length;
  }

  get values(): Float32Array<ArrayBuffer> {
    return new Float32Array(this.#values);
  }

  get lanes(): Float32Array<ArrayBuffer> {
    return new Float32Array(this.#lanes);
  }
}

function addLedgerLines(lines: Columns, note: ScoreNote, duration: number, step: number): void {
  for (const line of ledgerSteps(step)) {
    lines.add(note.player, note.onset_s, note.onset_s + duration, line, line);
  }
}

/**
 * Divide a score into chunks, by onset, whoever plays; every bar line belongs to the chunk in whose time it lies, and
 * is ruled in every lane.
 */
export function layOut(score: ScoreView): Chunk[] {
  const notes = [...score.notes].sort((a, b) => a.onset_s - b.onset_s);
  const bars = [...score.bar_lines_s].sort((a, b) => a - b);
  const chunks: Chunk[] = [];
  let bar = 0;
  for (let first = 0; first < Math.max(notes.length, 1); first += CHUNK_NOTES) {
    const members = notes.slice(first, first + CHUNK_NOTES);
    const until = notes[first + CHUNK_NOTES]?.onset_s ?? Number.POSITIVE_INFINITY;
    const columns = new Columns();
    const lines = new Columns();
    const pieces: number[] = [];
    let startS = members[0]?.onset_s ?? Number.POSITIVE_INFINITY;
    let endS = startS === Number.POSITIVE_INFINITY ? Number.NEGATIVE_INFINITY : startS;
    for (const note of members) {
      const { step, marks, duration } = blockOf(note);
      const { fingering } = note;
      pieces.push(fingering?.type === "strike" ? DRUM_PIECES.indexOf(fingering.piece) + 1 : 0);
      columns.add(note.player, note.onset_s, duration, step, marks);
      addLedgerLines(lines, note, duration, step);
      endS = Math.max(endS, note.onset_s + note.duration_s);
    }
    for (let at = bars[bar]; at !== undefined && at < until; at = bars[++bar]) {
      for (let lane = 0; lane < score.players; lane++) lines.add(lane, at, at, 0, 8);
      startS = Math.min(startS, at);
      endS = Math.max(endS, at);
    }
    if (columns.count + lines.count > 0) {
      const [notes, noteLanes] = [columns.values, columns.lanes];
      const notePieces = new Float32Array(pieces);
      chunks.push({ startS, endS, notes, noteLanes, notePieces, lines: lines.values, lineLanes: lines.lanes });
    }
  }
  return chunks;
}
