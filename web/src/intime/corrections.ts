import type { AlignedBar, AlignedBeat, AlignmentDocument, AnchorDocument } from "../generated/protocol";

/** What people have put right of where a score is heard: as the server keeps it beside what was found. */
export interface Corrections {
  /** In the score's order; `song_s` is before `offset_s` moves everything. */
  readonly anchors: readonly AnchorDocument[];
  readonly offset_s: number;
  /** Whether all is played in the recording's key, and not in the score's. */
  readonly follows_key?: boolean;
}

export const NOTHING: Corrections = { anchors: [], offset_s: 0 };

/** Places of the score nearer than this are the same, seconds; the server rounds beats to tenths of a millisecond. */
export const SAME_S = 0.001;
/** Two places that are put by hand are heard at least so far apart, seconds. */
export const APART_S = 0.02;

export function correctionsOf(document: AlignmentDocument | null): Corrections {
  const moved = { anchors: document?.anchors ?? [], offset_s: document?.offset_s ?? 0 };
  return document?.follows_key === true ? { ...moved, follows_key: true } : moved;
}

export function sameCorrections(one: Corrections, other: Corrections): boolean {
  return (
    one.offset_s === other.offset_s &&
    (one.follows_key ?? false) === (other.follows_key ?? false) &&
    one.anchors.length === other.anchors.length &&
    one.anchors.every((anchor, index) => {
      const beside = other.anchors[index];
      return anchor.score_s === beside?.score_s && anchor.song_s === beside.song_s;
    })
  );
}

/** The bar's line; null for a bar without beats, which the server does not send. */
export function lineOf(bar: AlignedBar | undefined): AlignedBeat | null {
  return bar?.beats[0] ?? null;
}

export function anchorAt(corrections: Corrections, score_s: number): AnchorDocument | null {
  return corrections.anchors.find((anchor) => Math.abs(anchor.score_s - score_s) < SAME_S) ?? null;
}

/** Everything heard so much later, seconds; to the millisecond. */
export function moved(corrections: Corrections, by: number): Corrections {
  return { ...corrections, offset_s: toMillisecond(corrections.offset_s + by) };
}

export function withoutAnchor(corrections: Corrections, score_s: number): Corrections {
  return {
    ...corrections,
    anchors: corrections.anchors.filter((anchor) => Math.abs(anchor.score_s - score_s) >= SAME_S),
  };
}

/** A bar line that is dragged to where it is heard. */
export interface Drag {
  readonly bars: readonly AlignedBar[];
  readonly corrections: Corrections;
  /** Which of the bars. */
  readonly index: number;
  /** Whether the bars beside it stay where they are; else all moves that no other anchor holds. */
  readonly around: boolean;
  /** Of the recording, seconds. */
  readonly duration: number;
}

/**
 * A bar line put where it is heard.
 *
 * @param song_s where it was let go, seconds of the recording; kept between what holds it
 */
export function withBarAt(drag: Drag, song_s: number): Corrections {
  const line = lineOf(drag.bars[drag.index]);
  if (line === null) return drag.corrections;
  const [low, high] = boundsOf(drag);
  const held = heldBeside(drag);
  const put = { score_s: line.score_s, song_s: toMillisecond(clamped(song_s, low, high) - drag.corrections.offset_s) };
  return { ...held, anchors: inOrder([...withoutAnchor(held, line.score_s).anchors, put]) };
}

/** Between which times of the recording a bar line can be put, seconds. */
export function boundsOf(drag: Drag): readonly [number, number] {
  const line = lineOf(drag.bars[drag.index]);
  if (line === null) return [0, drag.duration];
  const { anchors, offset_s } = heldBeside(drag);
  const before = anchors.findLast(({ score_s }) => score_s < line.score_s - SAME_S);
  const after = anchors.find(({ score_s }) => score_s > line.score_s + SAME_S);
  // What an anchor says is within the song before the offset moves it.
  return [
    before === undefined ? Math.max(offset_s, 0) : before.song_s + offset_s + APART_S,
    after === undefined ? drag.duration + Math.min(offset_s, 0) : after.song_s + offset_s - APART_S,
  ];
}

/** Anchors that hold bars where they are heard, beside what is put right from one bar to another. */
export function holding(
  bars: readonly AlignedBar[],
  corrections: Corrections,
  span: readonly [first: number, last: number],
  duration: number,
): Corrections {
  const [first, last] = span.map((index) => lineOf(bars[index])?.score_s ?? 0) as [number, number];
  const pins = [
    lineOf(bars.slice(0, span[0]).findLast(({ is_heard }) => is_heard)),
    lineOf(bars.slice(span[1] + 1).find(({ is_heard }) => is_heard)),
  ].flatMap((line): AnchorDocument[] => {
    if (line === null) return [];
    const [from, to] = line.score_s < first ? [line.score_s, first] : [last, line.score_s];
    const held = corrections.anchors.some(({ score_s }) =>
      line.score_s < first
        ? score_s > from - SAME_S && score_s < to - SAME_S
        : score_s > from + SAME_S && score_s < to + SAME_S,
    );
    const song_s = toMillisecond(line.song_s - corrections.offset_s);
    return held || song_s < 0 || song_s > duration ? [] : [{ score_s: line.score_s, song_s }];
  });
  return { ...corrections, anchors: inOrder([...corrections.anchors, ...pins]) };
}

/**
 * Where each bar line would be heard under other corrections, seconds of the recording, as the server reckons it:
 * stretched evenly between anchors, and moved along before the first and after the last.
 */
export function previewed(bars: readonly AlignedBar[], now: Corrections, then: Corrections): readonly number[] {
  const lines = bars.map((bar) => lineOf(bar)?.song_s ?? 0);
  if (then.anchors.length === 0) return lines.map((at) => at + then.offset_s - now.offset_s);
  const beats = bars.flatMap((bar) => bar.beats);
  const from = then.anchors.map(({ score_s }) => heardAt(beats, score_s));
  const to = then.anchors.map(({ song_s }) => song_s + then.offset_s);
  return bars.map((bar, index) => {
    const at = lines[index] ?? 0;
    const score_s = lineOf(bar)?.score_s ?? 0;
    const next = then.anchors.findIndex((anchor) => anchor.score_s > score_s + SAME_S);
    const after = next === -1 ? from.length : next;
    const before = after - 1;
    if (before < 0) return at + (to[0] ?? 0) - (from[0] ?? 0);
    const [begin, put] = [from[before] ?? 0, to[before] ?? 0];
    if (after === from.length) return at + put - begin;
    const [end, putEnd] = [from[after] ?? 0, to[after] ?? 0];
    return end - begin < SAME_S ? put : put + ((at - begin) / (end - begin)) * (putEnd - put);
  });
}

/** Where a place of the score is heard, in straight lines between its beats, seconds. */
export function heardAt(beats: readonly AlignedBeat[], score_s: number): number {
  const after = beats.findIndex((beat) => beat.score_s > score_s);
  const index = Math.max((after === -1 ? beats.length : after) - 1, 0);
  const [one, next] = [beats[index], beats[index + 1]];
  if (one === undefined) return score_s;
  if (next === undefined || next.score_s <= one.score_s || score_s < one.score_s)
    return one.song_s + score_s - one.score_s;
  return one.song_s + ((score_s - one.score_s) / (next.score_s - one.score_s)) * (next.song_s - one.song_s);
}

export function inOrder(anchors: readonly AnchorDocument[]): AnchorDocument[] {
  return [...anchors].sort((one, other) => one.score_s - other.score_s);
}

export function toMillisecond(seconds: number): number {
  return Math.round(seconds * 1000) / 1000;
}

function heldBeside({ bars, corrections, index, around, duration }: Drag): Corrections {
  return around ? holding(bars, corrections, [index, index], duration) : corrections;
}

function clamped(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), Math.max(high, low));
}
