import { barBeatAt, endOfLastBar, type BarBeat } from "../state/score-time";
import type { LoopSpan } from "./loop-span";
import { transport } from "../words/transport/en";

type ScoreGrid = Parameters<typeof barBeatAt>[0];

/** Nearer than this to a bar line, a time is on it, seconds. */
const ON_LINE_S = 2e-3;

/** A loop as a musician says it: its bars, or where it begins and ends within them. */
export function loopText(score: ScoreGrid, { start, end }: LoopSpan, duration: number): string {
  const lines = [...score.bar_lines_s, endOfLastBar(score)];
  const onLine = (time: number) => lines.some((line) => Math.abs(line - time) < ON_LINE_S);
  const first = barBeatAt(score, start + ON_LINE_S);
  if (!onLine(start) || !(onLine(end) || end > duration - ON_LINE_S)) {
    return transport.fromTo({ from: placeText(first), to: placeText(barBeatAt(score, end)) });
  }
  const last = barBeatAt(score, end - ON_LINE_S).bar;
  return first.bar === last ? transport.bar({ bar: last }) : transport.bars({ from: first.bar, to: last });
}

function placeText({ bar, beat }: BarBeat): string {
  return `${bar}·${beat}`;
}
