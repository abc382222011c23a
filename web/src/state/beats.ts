import type { Metre, Score } from "../generated/protocol";
import { barIndexAt, barLength, beatsAt, firstBarNumber, metreAt, songTimeOf } from "./score-time";

/** What a metronome clicks beside each bar's first beat: the other beats alone, or every eighth. */
export type Division = "beats" | "eighths";

/** One click: the first of a bar, another beat, or what lies between beats. */
export interface Click {
  /** Song time, seconds; within a count-in as if it were song before the place where song time stands. */
  readonly songTime: number;
  readonly kind: "bar" | "beat" | "division";
}

type ScoreGrid = Pick<Score, "tempi" | "metres" | "bar_lines_s">;

const SAME = 1e-6;
const EIGHTH = 0.5;

/**
 * How long a metre's beat is, quarter notes: its own note value, dotted in compound metres (6/8, 9/8, 12/8 and their
 * like), which are counted in twos, threes and fours.
 */
export function beatLength({ numerator, denominator }: Pick<Metre, "numerator" | "denominator">): number {
  const unit = 4 / denominator;
  return denominator >= 8 && numerator > 3 && numerator % 3 === 0 ? 3 * unit : unit;
}

/** A bar to click: where its grid begins and how long it is, quarter notes, and where it is heard. */
interface Bar {
  /** Of a pickup, where the whole bar would begin. */
  readonly begin: number;
  readonly length: number;
  readonly beat: number;
  /** Seconds of song a quarter note, on the average of the bar. */
  readonly quarter: number;
}

function barAt(score: ScoreGrid, index: number): Bar {
  const lines = score.bar_lines_s;
  const from = lines[index] ?? 0;
  const metre = metreAt(score.metres, from);
  const [length, beat] = [barLength(metre), beatLength(metre)];
  const begin = beatsAt(score.tempi, from);
  const next = lines[index + 1];
  const held = next === undefined ? length : beatsAt(score.tempi, next) - begin;
  const end = next ?? songTimeOf(score.tempi, begin + length);
  const quarter = held > SAME ? (end - from) / held : songTimeOf(score.tempi, begin + 1) - from;
  if (index > 0 || firstBarNumber(score) > 0) return { begin, length, beat, quarter };
  const whole = barLength(metreAt(score.metres, next ?? from));
  return { begin: begin + held - whole, length: whole, beat, quarter };
}

/** Where a bar's beats, and what divides them, lie from its begin on, quarter notes, as far as its end or further. */
function* gridOf({ beat, length }: Bar, division: Division, first: number): Generator<[number, Click["kind"]]> {
  // A beat that eighths do not divide is not divided.
  const parts = division === "eighths" ? beat / EIGHTH : 1;
  const count = Number.isInteger(parts) && parts > 1 ? parts : 1;
  const step = beat / count;
  const perBar = Math.max(Math.round(length / step), 1);
  for (let at = Math.ceil(first / step - SAME); ; at += 1) {
    const within = ((at % perBar) + perBar) % perBar;
    yield [at * step, within === 0 ? "bar" : within % count === 0 ? "beat" : "division"];
  }
}

/** The clicks from one song time up to, not including, another; none before the first bar line. */
export function clicksBetween(score: ScoreGrid, from: number, to: number, division: Division): readonly Click[] {
  const lines = score.bar_lines_s;
  const clicks: Click[] = [];
  for (let index = barIndexAt(lines, from); index < lines.length; index += 1) {
    const line = lines[index] ?? 0;
    if (line >= to - SAME) break;
    const bar = barAt(score, index);
    const next = lines[index + 1];
    const begins = beatsAt(score.tempi, line);
    const ends = next === undefined ? bar.begin + bar.length : beatsAt(score.tempi, next);
    for (const [quarters, kind] of gridOf(bar, division, begins - bar.begin)) {
      if (bar.begin + quarters >= ends - SAME) break;
      const songTime = songTimeOf(score.tempi, bar.begin + quarters);
      if (songTime >= from - SAME && songTime < to - SAME) clicks.push({ songTime, kind });
    }
  }
  return clicks;
}

/**
 * How long so many bars are counted in before a place of the song, song seconds, in the tempo of its bar.
 *
 * A count-in begins with a bar's first beat: what is played of a bar that begins in its middle, or with a pickup, is
 * counted up to. From a bar's second half on that is a bar less, so that a pickup comes in on its beat.
 */
export function countInLength(score: ScoreGrid, place: number, bars: number): number {
  if (bars <= 0) return 0;
  const bar = barAt(score, barIndexAt(score.bar_lines_s, place));
  const within = quartersInto(score, bar, place);
  const begun = within >= bar.length / 2 - SAME ? within - bar.length : within;
  return (bars * bar.length + begun) * bar.quarter;
}

/** The clicks of a count-in of so many song seconds before a place of the song. */
export function countInClicks(score: ScoreGrid, place: number, length: number, division: Division): readonly Click[] {
  const bar = barAt(score, barIndexAt(score.bar_lines_s, place));
  const within = quartersInto(score, bar, place);
  const clicks: Click[] = [];
  for (const [quarters, kind] of gridOf(bar, division, within - length / bar.quarter)) {
    if (quarters >= within - SAME) break;
    clicks.push({ songTime: place - (within - quarters) * bar.quarter, kind });
  }
  return clicks;
}

/** Quarter notes from the begin of a place's bar; before the first bar line the bars go on counting back. */
function quartersInto(score: ScoreGrid, bar: Bar, place: number): number {
  const quarters = beatsAt(score.tempi, place) - bar.begin;
  const within = ((quarters % bar.length) + bar.length) % bar.length;
  return bar.length - within < SAME ? 0 : within;
}
