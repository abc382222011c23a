import type { Score } from "../../generated/protocol";
import { barIndexAt, firstBarNumber } from "../../state/score-time";
import type { TimeAxis } from "../state/time-axis";

/** A line of the grid: a bar's number stands at numbered ones; beats have none. */
export interface GridLine {
  readonly time: number;
  readonly bar: number | null;
  readonly isBar: boolean;
}

/** Pixels from one bar's number to the next, and from one beat to the next, at least. */
const NUMBER_GAP = 46;
const BEAT_GAP = 14;
const MAX_LINES = 2000;

/** Bar lines and beats of a span of song time, seconds; beats and numbers only where there is room. */
export function gridLines(score: Score, axis: TimeAxis, from: number, to: number, scale: number): GridLine[] {
  const lines = score.bar_lines_s;
  const first = Math.max(barIndexAt(lines, from), 0);
  const found: GridLine[] = [];
  const offset = firstBarNumber(score);
  const middle = (from + to) / 2;
  const barPixels =
    axis.barLengthAt(axis.beatsAt(middle)) * (axis.secondsAt(axis.beatsAt(middle) + 1) - middle) * scale;
  const step = 2 ** Math.max(Math.ceil(Math.log2(NUMBER_GAP / Math.max(barPixels, 1e-6))), 0);
  for (let index = first; index < lines.length && found.length < MAX_LINES; index += 1) {
    const time = lines[index] ?? 0;
    if (time > to) break;
    const number = index + offset;
    const numbered = (number - 1) % step === 0;
    if (numbered || barPixels > BEAT_GAP / 2) found.push({ time, bar: numbered ? number : null, isBar: true });
    const next = lines[index + 1];
    if (next === undefined) break;
    const [begin, end] = [axis.beatsAt(time), axis.beatsAt(next)];
    if (((next - time) * scale) / (end - begin) < BEAT_GAP) continue;
    for (let beat = 1; beat < end - begin - 1e-6; beat += 1) {
      found.push({ time: axis.secondsAt(begin + beat), bar: null, isBar: false });
    }
  }
  return found;
}

const TIME_STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800] as const;

/** Seconds from one written time to the next. */
export function timeStep(scale: number, gap = 70): number {
  return TIME_STEPS.find((step) => step * scale >= gap) ?? 3600;
}
