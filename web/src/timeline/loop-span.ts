/** A passage that is played again and again, song time, seconds. */
export interface LoopSpan {
  readonly start: number;
  readonly end: number;
}

/** What of a loop is taken: its beginning, its end or all of it; or a new one is drawn. */
export type LoopPart = "new" | "start" | "end" | "whole";

/** No loop is shorter, seconds. */
export const SHORTEST_LOOP_S = 0.25;
/** From here on two times are one, seconds. */
const SAME_S = 1e-3;

/** What loops are drawn to: bar lines and the ends of the piece. */
export class LoopGrid {
  readonly #lines: readonly number[];
  readonly #duration: number;

  /**
   * @param barLines song time of each bar line, seconds, in their order.
   * @param duration of the piece, seconds.
   */
  constructor(barLines: readonly number[], duration: number) {
    const within = barLines.filter((line) => line > SAME_S && line < duration - SAME_S);
    this.#lines = [0, ...within, duration];
    this.#duration = duration;
  }

  /**
   * The loop between two places, whichever comes first: by whole bars, at least one.
   *
   * @param free whether it stays where the places are.
   */
  between(one: number, other: number, free = false): LoopSpan {
    const [low, high] = [Math.min(one, other), Math.max(one, other)];
    if (free) return this.#held(low, high);
    const [start, end] = [this.#nearest(low), this.#nearest(high)];
    return start === end ? this.bar(one) : this.#held(this.#at(start), this.#at(end));
  }

  /**
   * The loop from an end that stays to one that is held, on whichever side that is.
   *
   * @param free whether the held end stays where it is.
   */
  resized(fixed: number, held: number, free = false): LoopSpan {
    let end = free ? held : this.#at(this.#nearest(held));
    if (Math.abs(end - fixed) < SHORTEST_LOOP_S) end = free ? end : this.#next(fixed, held < fixed ? -1 : 1);
    return this.#held(Math.min(fixed, end), Math.max(fixed, end));
  }

  /** The bar around a song time. */
  bar(time: number): LoopSpan {
    const index = Math.min(
      Math.max(
        this.#lines.findLastIndex((line) => line <= time + SAME_S),
        0,
      ),
      this.#lines.length - 2,
    );
    return this.#held(this.#at(index), this.#at(index + 1));
  }

  /** A loop moved so that it begins near a place; one of whole bars keeps their number. */
  movedTo(loop: LoopSpan, start: number, free = false): LoopSpan {
    const [from, to] = [this.#indexOf(loop.start), this.#indexOf(loop.end)];
    if (!free && from >= 0 && to >= 0) {
      const index = Math.min(this.#nearest(start), this.#lines.length - 1 - (to - from));
      return { start: this.#at(index), end: this.#at(index + to - from) };
    }
    const length = loop.end - loop.start;
    const wanted = free ? start : this.#at(this.#nearest(start));
    const begin = Math.min(Math.max(wanted, 0), this.#duration - length);
    return { start: begin, end: begin + length };
  }

  /** A loop with its part, or all of it, a bar line further on or back. */
  stepped(loop: LoopSpan, part: "start" | "end" | "whole", direction: 1 | -1): LoopSpan {
    const to = this.#next(part === "end" ? loop.end : loop.start, direction);
    if (part === "whole") return this.movedTo(loop, to);
    const next = part === "start" ? { start: to, end: loop.end } : { start: loop.start, end: to };
    return next.end - next.start < SHORTEST_LOOP_S ? loop : next;
  }

  /** A loop with its part, or all of it, moved by seconds, free of the bars. */
  nudged(loop: LoopSpan, part: "start" | "end" | "whole", by: number): LoopSpan {
    if (part === "whole") return this.movedTo(loop, loop.start + by, true);
    const start = part === "start" ? Math.max(loop.start + by, 0) : loop.start;
    const end = part === "end" ? Math.min(loop.end + by, this.#duration) : loop.end;
    return end - start < SHORTEST_LOOP_S ? loop : { start, end };
  }

  /** The loop that begins at a place: its end stays where it comes later, else the piece's is its end. */
  from(time: number, loop: LoopSpan | null): LoopSpan {
    const start = Math.min(this.#at(this.#nearest(time)), this.#duration - SHORTEST_LOOP_S);
    const end = loop !== null && loop.end > start + SHORTEST_LOOP_S ? loop.end : this.#duration;
    return this.#held(start, end);
  }

  /** The loop that ends at a place: its beginning stays where it comes before, else the piece's is its beginning. */
  to(time: number, loop: LoopSpan | null): LoopSpan {
    const end = Math.max(this.#at(this.#nearest(time)), SHORTEST_LOOP_S);
    const start = loop !== null && loop.start < end - SHORTEST_LOOP_S ? loop.start : 0;
    return this.#held(start, end);
  }

  /** At least as long as a loop must be, inside of the piece. */
  #held(low: number, high: number): LoopSpan {
    const start = Math.min(Math.max(low, 0), Math.max(this.#duration - SHORTEST_LOOP_S, 0));
    return { start, end: Math.min(Math.max(high, start + SHORTEST_LOOP_S), this.#duration) };
  }

  #at(index: number): number {
    return this.#lines[index] ?? 0;
  }

  #indexOf(time: number): number {
    return this.#lines.findIndex((line) => Math.abs(line - time) < SAME_S);
  }

  #nearest(time: number): number {
    let best = 0;
    this.#lines.forEach((line, index) => {
      if (Math.abs(line - time) < Math.abs(this.#at(best) - time)) best = index;
    });
    return best;
  }

  #next(time: number, direction: 1 | -1): number {
    const next =
      direction === 1
        ? this.#lines.find((line) => line > time + SAME_S)
        : this.#lines.findLast((line) => line < time - SAME_S);
    return next ?? time;
  }
}
