import type { Loop } from "../generated/protocol";

interface Leg {
  /** Context time at which this leg begins, seconds. */
  readonly from: number;
  /** Place in the song there, seconds, not yet folded into the loop. */
  readonly position: number;
  readonly rate: number;
}

/** Where in the song what was scheduled is at any context time, through every change of its rate. */
export class PlaybackPath {
  readonly #legs: Leg[];
  readonly #loop: Loop | null;

  /** @param loop the loop it goes round in; null where it plays on to the song's end */
  constructor(from: number, position: number, rate: number, loop: Loop | null) {
    this.#legs = [{ from, position, rate }];
    this.#loop = loop;
  }

  /** Go on at another rate from a context time on. Times must come in order. */
  changeRate(from: number, rate: number): void {
    this.#legs.push({ from, position: this.#unfolded(from), rate });
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
    return foldIntoLoop(this.#unfolded(contextTime), this.#loop);
  }

  /** How far the place at a context time is ahead of `expected`, seconds; the shorter way round a loop. */
  errorAt(contextTime: number, expected: number): number {
    const error = this.positionAt(contextTime) - expected;
    if (this.#loop === null) return error;
    const length = this.#loop.end_s - this.#loop.start_s;
    return error - length * Math.round(error / length);
  }

  #unfolded(contextTime: number): number {
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

/** A place in the song that has run over the loop's end, taken back into the loop. */
export function foldIntoLoop(position: number, loop: Loop | null): number {
  if (loop === null || position < loop.end_s) return position;
  return loop.start_s + ((position - loop.start_s) % (loop.end_s - loop.start_s));
}
