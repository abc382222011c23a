const INTERVALS = 15;
const USUAL_S = 1 / 60;
const SHORTEST_S = 1 / 240;
/** A machine that draws more slowly is not looked ahead for any further: no two of its pictures take the same. */
const LONGEST_S = 1 / 30;
/** A pause, not a picture that took long. */
const PAUSE_S = 0.25;

/** When a picture that is drawn now will be seen: at the display's next turn, as far as the last turns tell. */
export class Refresh {
  readonly #intervals: number[] = [];
  #before = Number.NaN;
  #interval = USUAL_S;

  /** Seconds between two pictures: the median of the last. */
  get interval(): number {
    return this.#interval;
  }

  /**
   * The time at which what is drawn in this turn will be seen.
   *
   * @param turn the turn's own time, as requestAnimationFrame gives it; on the page's clock, seconds
   * @param now the page's clock, seconds
   */
  seenAt(turn: number, now: number): number {
    const interval = turn - this.#before;
    this.#before = turn;
    if (interval > 0 && interval < PAUSE_S) {
      this.#intervals.push(interval);
      if (this.#intervals.length > INTERVALS) this.#intervals.shift();
      const median = [...this.#intervals].sort((a, b) => a - b)[this.#intervals.length >> 1] ?? USUAL_S;
      this.#interval = Math.min(Math.max(median, SHORTEST_S), LONGEST_S);
    }
    return Math.max(turn, now - this.#interval) + this.#interval;
  }
}
