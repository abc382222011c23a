import type { Loop } from "../generated/protocol";

interface Leg {
  /** Context time at which this leg begins, seconds. */
  readonly from: number;
  /** Place in the song there, seconds, not yet folded into the loop. */
  readonly position: number;
  readonly rate: number;
}

/** A piece of a path on which the song runs on without a jump, or is counted in. */
export interface Piece {
  /** Places in the song, seconds; what is counted in counts as song before the place that follows. */
  readonly from: number;
  readonly to: number;
  /** What a place of it is further on in the path, seconds: `timeAt(place + shift)` is when it is heard. */
  readonly shift: number;
  /** The place that is counted in to; null where the song runs. */
  readonly countsTo: number | null;
}

/** Where in the song what was scheduled is at any context time, through every change of its rate. */
export class PlaybackPath {
  readonly loop: Loop | null;
  /** The place in the song at which it begins, seconds; what is counted in counts as song before it. */
  readonly begin: number;
  readonly #legs: Leg[];

  /** @param loop the loop it goes round in; null where it plays on to the song's end */
  constructor(from: number, position: number, rate: number, loop: Loop | null) {
    this.#legs = [{ from, position, rate }];
    this.begin = position;
    this.loop = loop;
  }

  /** Go on at another rate from a context time on. Times must come in order. */
  changeRate(from: number, rate: number): void {
    this.#legs.push({ from, position: this.unfoldedAt(from), rate });
    if (this.#legs.length > 4) this.#legs.shift();
  }

  /** Every change of rate from a context time on, in order. */
  changesFrom(contextTime: number): readonly { readonly from: number; readonly rate: number }[] {
    return this.#legs.filter(({ from }) => from > contextTime);
  }

  rateAt(contextTime: number): number {
    return this.#legAt(contextTime).rate;
  }

  /** The context time at which so much of the song will have passed, seconds, counted on over the loop's end. */
  timeAt(unfolded: number): number {
    let leg = this.#first;
    for (const each of this.#legs) if (each.position <= unfolded) leg = each;
    return leg.from + (unfolded - leg.position) / leg.rate;
  }

  /** Place in the song at a context time, seconds. */
  positionAt(contextTime: number): number {
    return foldIntoLoop(Math.max(this.unfoldedAt(contextTime), this.begin), this.loop);
  }

  /** The pieces between two places of the path, seconds, counted on over the loop's end. */
  piecesBetween(from: number, to: number): readonly Piece[] {
    const pieces: Piece[] = [];
    let at = from;
    const add = (until: number, shift: number, countsTo: number | null): void => {
      const end = Math.min(until, to);
      if (end > at) pieces.push({ from: at - shift, to: end - shift, shift, countsTo });
      at = Math.max(at, until);
    };
    add(this.begin, 0, this.begin);
    const { loop } = this;
    if (loop === null) add(Infinity, 0, null);
    else {
      add(loop.end_s, 0, null);
      const round = roundOf(loop);
      for (let turn = Math.floor((at - loop.end_s) / round); at < to; turn += 1) {
        const begins = loop.end_s + turn * round + loop.count_in_s;
        add(begins, begins - loop.start_s, loop.start_s);
        add(loop.end_s + (turn + 1) * round, begins - loop.start_s, null);
      }
    }
    return pieces;
  }

  /** How far the place at a context time is ahead of `expected`, seconds; the shorter way round a loop. */
  errorAt(contextTime: number, expected: number): number {
    const error = this.positionAt(contextTime) - expected;
    if (this.loop === null) return error;
    const length = this.loop.end_s - this.loop.start_s;
    return error - length * Math.round(error / length);
  }

  /** Song seconds that are still counted in at a context time. */
  countInAt(contextTime: number): number {
    const unfolded = this.unfoldedAt(contextTime);
    return Math.max(this.begin - unfolded, countInWithin(unfolded, this.loop));
  }

  /** How much of the song has passed at a context time, seconds, counted on over the loop's end. */
  unfoldedAt(contextTime: number): number {
    const leg = this.#legAt(contextTime);
    return leg.position + (contextTime - leg.from) * leg.rate;
  }

  #legAt(contextTime: number): Leg {
    let leg = this.#first;
    for (const each of this.#legs) if (each.from <= contextTime) leg = each;
    return leg;
  }

  get #first(): Leg {
    const [first] = this.#legs;
    if (first === undefined) throw new RangeError("a path has a beginning");
    return first;
  }
}

/** A place in the song that has run over the loop's end, taken back into the loop; its begin while that is counted in. */
export function foldIntoLoop(position: number, loop: Loop | null): number {
  if (loop === null || position < loop.end_s) return position;
  return loop.start_s + Math.max(((position - loop.end_s) % roundOf(loop)) - loop.count_in_s, 0);
}

/** Song seconds that are still counted in, of the round that begins, at a place that has run over the loop's end. */
export function countInWithin(position: number, loop: Loop | null): number {
  if (loop === null || position < loop.end_s) return 0;
  return Math.max(loop.count_in_s - ((position - loop.end_s) % roundOf(loop)), 0);
}

/** Song seconds from one round's beginning to the next one's: what is counted in, and the loop. */
export function roundOf(loop: Loop): number {
  return loop.count_in_s + loop.end_s - loop.start_s;
}
