import type { Score } from "../generated/protocol";
import { barIndexAt, endOfLastBar, firstBarNumber } from "../state/score-time";
import type { LoopSpan } from "../timeline/loop-span";

type ScoreGrid = Pick<Score, "tempi" | "metres" | "bar_lines_s">;

/** Bars by their numbers, both included. */
export interface Bars {
  readonly from: number;
  readonly to: number;
}

/** Nearer than this to a bar line, a time is on it, seconds. */
const ON_LINE_S = 0.02;

/** Shorter loops the server refuses, seconds. */
const SHORTEST_S = 0.1;

/** All the bars that there are. */
export function allBars(score: ScoreGrid): Bars {
  const from = firstBarNumber(score);
  return { from, to: from + Math.max(score.bar_lines_s.length - 1, 0) };
}

/**
 * The song time of bars, from the first one's bar line to the one behind the last; where a recording leaves all of
 * them out, that of the nearest bar that is heard.
 *
 * @param duration where the song ends, seconds.
 */
export function spanOfBars(score: ScoreGrid, { from, to }: Bars, duration: number): LoopSpan {
  const lines = score.bar_lines_s;
  const first = from - firstBarNumber(score);
  const last = to - firstBarNumber(score);
  const start = lines[first] ?? 0;
  const ends = [...lines.slice(last + 1), endOfLastBar(score)].map((line) => Math.min(line, duration));
  const end = ends.find((line) => line - start >= SHORTEST_S) ?? duration;
  return { start: lines.findLast((line) => line <= start && end - line >= SHORTEST_S) ?? 0, end };
}

/** The bars that a span of song time, seconds, lies in: whole ones, and at least one. */
export function barsAround(score: ScoreGrid, { start, end }: LoopSpan): Bars {
  const lines = score.bar_lines_s;
  const first = barIndexAt(lines, start + ON_LINE_S);
  const last = Math.max(barIndexAt(lines, end - ON_LINE_S), first);
  return { from: first + firstBarNumber(score), to: last + firstBarNumber(score) };
}

/** Bars with one end moved: within those that there are, and the other end goes along where it must. */
export function withEnd(bars: Bars, end: "from" | "to", number: number, all: Bars): Bars {
  const held = Math.min(Math.max(Math.round(number), all.from), all.to);
  return end === "from" ? { from: held, to: Math.max(bars.to, held) } : { from: Math.min(bars.from, held), to: held };
}
