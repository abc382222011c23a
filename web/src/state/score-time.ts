import type { Metre, Score, Tempo } from "../generated/protocol";

/** A place in the score as musicians say it: bar and beat, both counted from 1; a pickup is bar 0. */
export interface BarBeat {
  readonly bar: number;
  readonly beat: number;
}

type ScoreGrid = Pick<Score, "tempi" | "metres" | "bar_lines_s">;

/** Quarter notes from the score's beginning at a song time, seconds. */
export function beatsAt(tempi: readonly Tempo[], songTime: number): number {
  const tempo = lastBegun(tempi, songTime);
  return tempo === undefined ? songTime * 2 : tempo.onset_beats + ((songTime - tempo.onset_s) * tempo.bpm) / 60;
}

/** Song time, seconds, of a place that lies so many quarter notes from the score's beginning. */
export function songTimeOf(tempi: readonly Tempo[], beats: number): number {
  const tempo = tempi.findLast(({ onset_beats }) => onset_beats <= beats + 1e-9) ?? tempi[0];
  return tempo === undefined ? beats / 2 : tempo.onset_s + ((beats - tempo.onset_beats) * 60) / tempo.bpm;
}

/** The index of the bar that a song time, seconds, falls in; behind the last bar line it is the last bar. */
export function barIndexAt(barLines: readonly number[], songTime: number): number {
  let low = 0;
  let high = barLines.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((barLines[middle] ?? Infinity) <= songTime + 1e-6) low = middle + 1;
    else high = middle;
  }
  return Math.max(low - 1, 0);
}

/** The number that the score's first bar goes by: 0 for a pickup, else 1. */
export function firstBarNumber(score: ScoreGrid): number {
  const [first, second] = score.bar_lines_s;
  if (first === undefined || second === undefined) return 1;
  const leftOut = barIndexAt(score.bar_lines_s, first);
  if (leftOut > 0) {
    // The first bars take no time, which cannot tell how long they are.
    const heard = beatsAt(score.tempi, first);
    return beatsOfBars(score.metres, leftOut) > heard + 1e-6 ? 0 : 1;
  }
  const length = beatsAt(score.tempi, second) - beatsAt(score.tempi, first);
  return length < barLength(metreAt(score.metres, second)) - 1e-6 ? 0 : 1;
}

/**
 * Bar and beat at a song time, seconds; before the music the bars go on counting back. The beat counts the metre's
 * own note values (eighths in 6/8).
 */
export function barBeatAt(score: ScoreGrid, songTime: number): BarBeat {
  // Before the music it is the bar that is heard first: one that a recording leaves out takes no time.
  const index = barIndexAt(score.bar_lines_s, Math.max(songTime, score.bar_lines_s[0] ?? 0));
  const barBegin = score.bar_lines_s[index] ?? 0;
  const quarters = beatsAt(score.tempi, songTime) - beatsAt(score.tempi, barBegin);
  const { numerator, denominator } = metreAt(score.metres, songTime);
  const beats = Math.floor((quarters * denominator) / 4 + 1e-6);
  // In a recording the first bar may begin after a while.
  const before = beats < 0 ? Math.floor(beats / numerator) : 0;
  return { bar: index + firstBarNumber(score) + before, beat: beats - before * numerator + 1 };
}

/** Where the last bar ends, song time, seconds: a score has no bar line there. */
export function endOfLastBar(score: ScoreGrid): number {
  const last = score.bar_lines_s.at(-1) ?? 0;
  return songTimeOf(score.tempi, beatsAt(score.tempi, last) + barLength(metreAt(score.metres, last)));
}

/**
 * The bar line to go to from a song time: the next one, or the one before (from within a bar first its own).
 *
 * @param direction 1 forward, -1 back
 */
export function neighbouringBarLine(score: ScoreGrid, songTime: number, direction: 1 | -1, duration: number): number {
  const lines = score.bar_lines_s;
  if (direction === 1) return lines.find((line) => line > songTime + 0.02) ?? duration;
  // While it plays, a second press must reach the bar before: leave a little time for it.
  return lines.findLast((line) => line < songTime - 0.25) ?? 0;
}

/** The metre at a song time, seconds. */
export function metreAt(metres: readonly Metre[], songTime: number): Metre {
  return lastBegun(metres, songTime) ?? { onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 };
}

/** How long a metre's bar is, quarter notes. */
export function barLength(metre: Metre): number {
  return (metre.numerator * 4) / metre.denominator;
}

/** How long a score's first bars are, quarter notes, if none of them is a pickup. */
function beatsOfBars(metres: readonly Metre[], bars: number): number {
  let beats = 0;
  for (let bar = 0; bar < bars; bar += 1) {
    const metre = metres.findLast(({ onset_beats }) => onset_beats <= beats + 1e-6) ?? metreAt([], 0);
    beats += barLength(metre);
  }
  return beats;
}

function lastBegun<T extends { onset_s: number }>(entries: readonly T[], songTime: number): T | undefined {
  // Before all of them it is the one that lasts: those that a recording leaves out begin and end with it.
  const first = entries[0]?.onset_s ?? 0;
  return entries.findLast((entry) => entry.onset_s <= Math.max(songTime, first) + 1e-6);
}
