import type { AlignedBar, AlignedBeat, AnchorDocument } from "../generated/protocol";
import { APART_S, holding, inOrder, lineOf, moved, SAME_S, toMillisecond, type Corrections } from "./corrections";

/** What was tapped along, and to what. */
export interface Tapping {
  /** Song times of the taps, rising, seconds. */
  readonly taps: readonly number[];
  readonly bars: readonly AlignedBar[];
  readonly corrections: Corrections;
  /** Which bar begins at the first tap; null: the taps lie near where their beats are thought to be. */
  readonly firstBar: number | null;
  /** Whether the bars beside what was tapped stay where they are. */
  readonly around: boolean;
  /** Of the recording, seconds. */
  readonly duration: number;
}

/** What taps say. */
export interface TapReading {
  readonly corrections: Corrections;
  /** By how much all is moved, seconds; null where bar lines were put. */
  readonly by: number | null;
  /** How many bar lines or beats were put; 0 where all is moved alike. */
  readonly placed: number;
  /** Taps that fitted no beat. */
  readonly left: number;
}

/** So few taps say nothing. */
export const FEWEST_TAPS = 4;
/** Taps nearer than this share of their distance are a hand's slip. */
const SLIP = 0.4;
/** Taps that vary by less are in time with the beats, seconds: then all is moved alike. */
const STEADY_S = 0.06;
/** A tap further than this from its neighbours' displacement is left out, seconds, or so many deviations. */
const AWRY_S = 0.1;
const AWRY_DEVIATIONS = 3;
/** A deviation of normal errors, of their median size. */
const DEVIATION = 1.4826;
/** How many taps on either side say whether one is awry, and how many it is drawn through: a few, for tempos bend. */
const JUDGES = 3;
const REACH = 2;
/** Beats that people tap once in. */
const UNITS = [1, 2, 3, 4, 0.5] as const;
/** A tempo that is so many times as fast or slow is still taken for the same beats. */
const OTHER_UNIT = 1.6;

interface Pair {
  readonly beat: AlignedBeat;
  /** How much later than it was thought to be it was tapped, seconds. */
  readonly late: number;
}

/**
 * Read taps as beats: by the median of how late they are where that is steady, else as anchors at the bar lines
 * that were tapped, each drawn through its neighbours. Null for too few taps, or taps where no beats are.
 */
export function readTaps(tapping: Tapping): TapReading | null {
  const taps = withoutSlips(tapping.taps);
  const beats = tapping.bars.flatMap((bar) => bar.beats);
  if (taps.length < FEWEST_TAPS || beats.length < 2) return null;
  const pairs = paired(taps, beats, tapping);
  const kept = withoutAwry(pairs);
  if (kept.length < FEWEST_TAPS) return null;
  const left = tapping.taps.length - kept.length;
  const smooth = smoothed(kept);
  const by = toMillisecond(median(kept.map(({ late }) => late)));
  if (Math.max(...smooth) - Math.min(...smooth) <= STEADY_S) {
    return { corrections: moved(tapping.corrections, by), by, placed: 0, left };
  }
  const { corrections, placed } = anchored(kept, smooth, tapping);
  return { corrections, by: null, placed, left };
}

/** How many beats lie from one tap to the next: as conducted, by bars, or twice as fast. */
export function unitOf(interval: number, beat: number): number {
  const off = (unit: number): number => Math.abs(Math.log(interval / (unit * beat)));
  if (off(1) <= Math.log(OTHER_UNIT)) return 1;
  return UNITS.reduce<number>((best, unit) => (off(unit) < off(best) ? unit : best), 1);
}

function withoutSlips(taps: readonly number[]): number[] {
  const intervals = taps.slice(1).map((tap, index) => tap - (taps[index] ?? 0));
  const least = SLIP * median(intervals);
  const kept: number[] = [];
  for (const tap of taps) {
    const last = kept.at(-1);
    if (last === undefined || tap - last > least) kept.push(tap);
  }
  return kept;
}

/** Each tap with its beat: the taps are counted by their own pulse, which may slow down or leave beats out. */
function paired(taps: readonly number[], beats: readonly AlignedBeat[], { bars, firstBar }: Tapping): Pair[] {
  const intervals = taps.slice(1).map((tap, index) => tap - (taps[index] ?? 0));
  let pulse = median(intervals);
  const counts = [0];
  const recent: number[] = [];
  for (const interval of intervals) {
    const count = Math.max(Math.round(interval / pulse), 1);
    counts.push((counts.at(-1) ?? 0) + count);
    recent.push(interval / count);
    pulse = median(recent.slice(-4));
  }
  const line = firstBar === null ? null : lineOf(bars[firstBar]);
  const nearest = line === null ? nearestBeat(beats, taps[0] ?? 0) : beats.indexOf(line);
  const unit = unitOf(median(intervals), beatLength(beats, nearest));
  const pairsFrom = (first: number): Pair[] =>
    counts.flatMap((count, index) => {
      const place = first + count * unit;
      const beat = Number.isInteger(place) ? beats[place] : undefined;
      return beat === undefined ? [] : [{ beat, late: (taps[index] ?? 0) - beat.song_s }];
    });
  if (line !== null) return pairsFrom(nearest);
  const off = (pairs: readonly Pair[]): number =>
    pairs.length < FEWEST_TAPS ? Infinity : Math.abs(median(pairs.map(({ late }) => late)));
  return [nearest - 1, nearest, nearest + 1]
    .filter((first) => first >= 0)
    .map(pairsFrom)
    .reduce<Pair[]>((best, pairs) => (off(pairs) < off(best) ? pairs : best), []);
}

function withoutAwry(pairs: readonly Pair[]): Pair[] {
  const off = pairs.map((pair, index) => Math.abs(pair.late - lineThrough(around(pairs, index, JUDGES), pair)));
  const most = Math.max(AWRY_S, AWRY_DEVIATIONS * DEVIATION * median(off));
  return pairs.filter((_, index) => (off[index] ?? 0) <= most);
}

/** How late a tap would be by its neighbours, whatever one of them is: the medians of their slopes and heights. */
function lineThrough(near: readonly Pair[], { beat }: Pair): number {
  const slopes = near.flatMap((one, index) =>
    near.slice(index + 1).map((other) => (other.late - one.late) / (other.beat.song_s - one.beat.song_s || 1)),
  );
  const slope = median(slopes);
  return median(near.map((one) => one.late + slope * (beat.song_s - one.beat.song_s)));
}

/** How late each is by a straight line through its neighbours, seconds. */
function smoothed(pairs: readonly Pair[]): number[] {
  return pairs.map(({ beat }, index) => {
    const near = around(pairs, index, REACH);
    const [x, y] = [mean(near.map((pair) => pair.beat.song_s)), mean(near.map(({ late }) => late))];
    const spread = near.reduce((sum, pair) => sum + (pair.beat.song_s - x) ** 2, 0);
    const slope =
      spread === 0 ? 0 : near.reduce((sum, pair) => sum + (pair.beat.song_s - x) * (pair.late - y), 0) / spread;
    return y + slope * (beat.song_s - x);
  });
}

function anchored(
  pairs: readonly Pair[],
  smooth: readonly number[],
  { bars, corrections, around: held, duration }: Tapping,
): { corrections: Corrections; placed: number } {
  const lines = new Map(bars.map((bar, index) => [bar.beats[0], index]));
  const places = pairs.map(({ beat }, index): AnchorDocument & { readonly beat: AlignedBeat } => ({
    beat,
    score_s: beat.score_s,
    song_s: toMillisecond(beat.song_s + (smooth[index] ?? 0) - corrections.offset_s),
  }));
  const atLines = places.filter(({ beat }) => lines.has(beat));
  // One bar line alone would move all: the first and the last beat say the tempo too.
  const wanted =
    atLines.length >= 2 ? atLines : places.filter((_, index) => index === 0 || index === places.length - 1);
  const [from, to] = [places[0]?.score_s ?? 0, places.at(-1)?.score_s ?? 0];
  const others = corrections.anchors.filter(({ score_s }) => score_s < from - SAME_S || score_s > to + SAME_S);
  const span = [
    bars.findLastIndex((bar) => (lineOf(bar)?.score_s ?? 0) <= from + SAME_S),
    bars.findLastIndex((bar) => (lineOf(bar)?.score_s ?? 0) <= to + SAME_S),
  ] as const;
  const beside = { ...corrections, anchors: others };
  const around = held ? holding(bars, beside, span, duration) : beside;
  const put = wanted
    .map(({ score_s, song_s }) => ({ score_s, song_s }))
    .filter(({ song_s }) => song_s >= 0 && song_s <= duration);
  // Nothing may run backwards: what was tapped goes before what only holds.
  const fits = around.anchors.filter((anchor) =>
    put.every(({ score_s, song_s }) =>
      anchor.score_s < score_s ? anchor.song_s < song_s - APART_S : anchor.song_s > song_s + APART_S,
    ),
  );
  const rising = put.filter(({ song_s }, index) => index === 0 || song_s > (put[index - 1]?.song_s ?? 0) + APART_S);
  return { corrections: { ...corrections, anchors: inOrder([...fits, ...rising]) }, placed: rising.length };
}

function nearestBeat(beats: readonly AlignedBeat[], song_s: number): number {
  return beats.reduce(
    (best, beat, index) =>
      Math.abs(beat.song_s - song_s) < Math.abs((beats[best]?.song_s ?? Infinity) - song_s) ? index : best,
    0,
  );
}

/** About how long a beat lasts there, seconds of the recording. */
function beatLength(beats: readonly AlignedBeat[], index: number): number {
  const near = beats.slice(Math.max(index - 4, 0), index + 5);
  const lengths = near.slice(1).map((beat, place) => beat.song_s - (near[place]?.song_s ?? 0));
  return Math.max(median(lengths.filter((length) => length > SAME_S)), SAME_S);
}

function around<T>(items: readonly T[], index: number, reach: number): readonly T[] {
  return items.slice(Math.max(index - reach, 0), index + reach + 1);
}

function mean(values: readonly number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function median(values: readonly number[]): number {
  const sorted = [...values].sort((one, other) => one - other);
  const middle = sorted.length >> 1;
  if (sorted.length === 0) return 0;
  return sorted.length % 2 === 1 ? (sorted[middle] ?? 0) : ((sorted[middle - 1] ?? 0) + (sorted[middle] ?? 0)) / 2;
}
