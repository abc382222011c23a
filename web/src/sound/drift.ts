/** What to do about sound that is not where it should be. */
export type Correction =
  | { readonly kind: "none" }
  /** Play at `rate` times the rate for so many seconds, then exactly at the rate again. */
  | { readonly kind: "burst"; readonly rate: number; readonly seconds: number }
  /** Too far off to be caught up with unheard: start anew at the right place. */
  | { readonly kind: "restart" };

/** Nobody hears less than this, and it leaves the picture most of the 25 ms that the two may be apart. */
export const TOLERATED_S = 0.006;
const RESTART_FROM_S = 0.15;
const BURST = 0.03;
const READINGS = 5;

const none: Correction = { kind: "none" };

/**
 * Decides when sound is brought back: never a little all the time (that wavers), but one short burst until it is level.
 */
export class DriftWatch {
  readonly #errors: number[] = [];

  /** Forget the readings, as after a start, a seek or a correction. */
  reset(): void {
    this.#errors.length = 0;
  }

  /** The median of the last readings, seconds by which the sound is ahead; null while there are too few. */
  get error(): number | null {
    if (this.#errors.length < READINGS) return null;
    const sorted = [...this.#errors].sort((a, b) => a - b);
    return sorted[READINGS >> 1] ?? null;
  }

  /**
   * Take in one reading and say what to do.
   *
   * @param error seconds of song by which the sound is ahead of where it should be
   * @param rate song seconds a second at which it plays
   */
  read(error: number, rate: number): Correction {
    this.#errors.push(error);
    if (this.#errors.length > READINGS) this.#errors.shift();
    const median = this.error;
    if (median === null || Math.abs(median) <= TOLERATED_S) return none;
    this.reset();
    if (Math.abs(median) >= RESTART_FROM_S) return { kind: "restart" };
    return { kind: "burst", rate: median > 0 ? 1 - BURST : 1 + BURST, seconds: Math.abs(median) / (BURST * rate) };
  }
}
