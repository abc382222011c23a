import type { Score, WireNote } from "../generated/protocol";
import { barNumberStep, pitchRange, type Phrase } from "../state/overview";
import { firstBarNumber } from "../state/score-time";

/** What the overview shows, and how large, in CSS pixels. */
export interface Overview {
  readonly score: Score;
  readonly played: readonly WireNote[];
  readonly phrases: readonly Phrase[];
  /** Seconds from the left edge to the right one. */
  readonly duration: number;
  readonly width: number;
  readonly height: number;
}

/** The colours of one drawing of the overview: the same is drawn for what lies ahead and for what has been played. */
export interface OverviewInk {
  readonly played: string;
  readonly others: string;
  readonly phrase: string;
  readonly tick: string;
  readonly number: string;
}

const HEAD = 18;
const FOOT = 9;
const NUMBER_GAP = 44;
const MIN_NOTE = 1.5;

/** Draw the score once: notes by time and pitch, phrases beneath, bar ticks and numbers above. */
export function drawOverview(context: CanvasRenderingContext2D, overview: Overview, ink: OverviewInk): void {
  const { score, played, width, height } = overview;
  context.clearRect(0, 0, width, height);
  drawBars(context, overview, ink);
  const range = pitchRange(score.notes);
  context.fillStyle = ink.others;
  for (const note of score.notes) if (note.player !== 0) drawNote(context, overview, note, range, 1.5);
  context.fillStyle = ink.played;
  for (const note of played) drawNote(context, overview, note, range, 3);
  context.fillStyle = ink.phrase;
  for (const { start, end } of overview.phrases) {
    const x = xOf(overview, start);
    fillBar(context, x, height - 5, Math.max(xOf(overview, end) - x - 2, MIN_NOTE), 2.5);
  }
}

function drawBars(context: CanvasRenderingContext2D, overview: Overview, ink: OverviewInk): void {
  const lines = overview.score.bar_lines_s.filter((line) => line <= overview.duration);
  const step = barNumberStep(lines.length, overview.width, NUMBER_GAP);
  const first = firstBarNumber(overview.score);
  context.font = `500 11px "Instrument Sans", system-ui, sans-serif`;
  context.textBaseline = "top";
  lines.forEach((line, index) => {
    const x = Math.round(xOf(overview, line));
    const number = index + first;
    const numbered = number === 1 || (number > 0 && (number - 1) % step === 0);
    if (!numbered && step > 4) return;
    context.fillStyle = ink.tick;
    context.fillRect(x, numbered ? 3 : HEAD - 5, 1, numbered ? HEAD - 4 : 4);
    if (!numbered || x > overview.width - 14) return;
    context.fillStyle = ink.number;
    context.fillText(String(number), x + 5, 3);
  });
}

function drawNote(
  context: CanvasRenderingContext2D,
  overview: Overview,
  note: WireNote,
  [low, high]: readonly [number, number],
  thickness: number,
): void {
  const x = xOf(overview, note.onset_s);
  const end = xOf(overview, note.onset_s + note.duration_s);
  const room = overview.height - HEAD - FOOT - thickness - 2;
  const y = HEAD + 1 + (1 - (note.sounding_pitch - low) / (high - low)) * room;
  fillBar(context, x, y, Math.max(end - x - 0.75, MIN_NOTE), thickness);
}

function fillBar(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number): void {
  context.beginPath();
  context.roundRect(x, y, width, height, Math.min(height / 2, width / 2));
  context.fill();
}

function xOf({ duration, width }: Overview, time: number): number {
  return (time / Math.max(duration, 1e-6)) * width;
}
