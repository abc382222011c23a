import type { Score, WireNote } from "../generated/protocol";
import { isPlayed, lineNotes } from "../state/line-notes";
import { barNumberStep, pitchRange, type Phrase } from "../state/overview";
import { firstBarNumber } from "../state/score-time";

/** The notes of a score, sorted out once for all its drawings. */
export interface OverviewNotes {
  /** What nobody on the stage plays. */
  readonly others: readonly WireNote[];
  /** Each player's line, a place in the cast; who is followed comes last, over the others. */
  readonly lines: readonly {
    readonly player: number;
    readonly followed: boolean;
    readonly notes: readonly WireNote[];
  }[];
  /** The lowest and the highest pitch. */
  readonly range: readonly [number, number];
}

/** What the overview shows, and how large, in CSS pixels. */
export interface Overview {
  readonly score: Score;
  readonly notes: OverviewNotes;
  readonly phrases: readonly Phrase[];
  readonly duration: number;
  /** Song time at the left edge, seconds, and pixels a second. */
  readonly from: number;
  readonly scale: number;
  readonly width: number;
  readonly height: number;
}

/** The colours of one drawing of the overview: the same is drawn for what lies ahead and for what has been played. */
export interface OverviewInk {
  /** Of each player's notes. */
  readonly played: (player: number) => string;
  /** Of what nobody on the stage plays. */
  readonly others: string;
  readonly phrase: string;
  readonly tick: string;
  readonly number: string;
}

/** Height of the bar numbers, along which loops are drawn, pixels. */
export const STRIP = 24;
const FOOT = 9;
const NUMBER_GAP = 44;
const MIN_NOTE = 1.5;
/** Where bars are as far apart as this, pixels, lines stand between the notes. */
const LINES_GAP = 90;

/** @param followed place in the cast of the player whose notes stand out. */
export function overviewNotes(score: Score, followed: number): OverviewNotes {
  const others = score.notes.filter((note) => note.player === null || !isPlayed(note));
  const players = [...new Set(score.notes.flatMap(({ player }) => (player === null ? [] : [player])))];
  const lines = players
    .sort((a, b) => Number(a === followed) - Number(b === followed) || a - b)
    .map((player) => ({
      player,
      followed: player === followed,
      notes: lineNotes(score.notes.filter((note) => note.player === player)),
    }));
  return { others, lines, range: pitchRange(score.notes) };
}

/** Draw what is on screen of the score: notes by time and pitch, phrases beneath, bar ticks and numbers above. */
export function drawOverview(context: CanvasRenderingContext2D, overview: Overview, ink: OverviewInk): void {
  const { notes, width, height } = overview;
  context.clearRect(0, 0, width, height);
  drawBars(context, overview, ink);
  context.fillStyle = ink.others;
  for (const note of notes.others) drawNote(context, overview, note, 1.5);
  for (const { player, followed, notes: line } of notes.lines) {
    context.fillStyle = ink.played(player);
    for (const note of line) drawNote(context, overview, note, followed ? 3 : 2);
  }
  context.fillStyle = ink.phrase;
  for (const { start, end } of overview.phrases) {
    const x = xOf(overview, start);
    const room = Math.max(xOf(overview, end) - x - 2, MIN_NOTE);
    if (x < width && x + room > 0) fillBar(context, x, height - 5, room, 2.5);
  }
}

function drawBars(context: CanvasRenderingContext2D, overview: Overview, ink: OverviewInk): void {
  const { scale, width, height, duration } = overview;
  const lines = overview.score.bar_lines_s.filter((line) => line <= duration);
  const step = barNumberStep(lines.length, duration * scale, NUMBER_GAP);
  const first = firstBarNumber(overview.score);
  const far = (duration * scale) / Math.max(lines.length, 1) >= LINES_GAP;
  context.font = `500 11px "Instrument Sans", system-ui, sans-serif`;
  context.textBaseline = "top";
  lines.forEach((line, index) => {
    const x = Math.round(xOf(overview, line));
    if (x < -NUMBER_GAP || x > width) return;
    const number = index + first;
    const numbered = number === 1 || (number > 0 && (number - 1) % step === 0);
    if (!numbered && step > 4) return;
    context.fillStyle = ink.tick;
    context.fillRect(x, numbered ? 5 : STRIP - 6, 1, (far ? height - FOOT : STRIP - 1) - (numbered ? 5 : STRIP - 6));
    if (!numbered || x > width - 14) return;
    context.fillStyle = ink.number;
    context.fillText(String(number), x + 5, 6);
  });
}

function drawNote(context: CanvasRenderingContext2D, overview: Overview, note: WireNote, thickness: number): void {
  const x = xOf(overview, note.onset_s);
  const end = xOf(overview, note.onset_s + note.duration_s);
  if (x > overview.width || end < 0) return;
  const [low, high] = overview.notes.range;
  const room = overview.height - STRIP - FOOT - thickness - 2;
  const y = STRIP + 1 + (1 - (note.sounding_pitch - low) / (high - low)) * room;
  fillBar(context, x, y, Math.max(end - x - 0.75, MIN_NOTE), thickness);
}

function fillBar(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number): void {
  context.beginPath();
  context.roundRect(x, y, width, height, Math.min(height / 2, width / 2));
  context.fill();
}

function xOf({ from, scale }: Overview, time: number): number {
  return (time - from) * scale;
}
