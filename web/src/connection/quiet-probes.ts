import type { ClockProbe, ClockSync } from "./clock-sync";

/** Over a shorter round trip than this the stream's own probes are exact enough. */
const FAR_ROUND_TRIP_S = 0.01;
const EAGER = 16;
const EAGER_INTERVAL_S = 0.25;
const INTERVAL_S = 3;

/**
 * Probes of the clock beside the stream, behind a slow network.
 *
 * TCP keeps its order: on the stream each pong waits for the frames before it, whichever of them takes longest, and
 * so comes later than any ping goes, by 20 ms where jitter is 50. On a connection of their own the two ways are alike.
 */
export class QuietProbes {
  readonly #clock: ClockSync;
  readonly #ask: () => Promise<ClockProbe>;
  #count = 0;
  #closed = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #asking = false;

  /** @param ask one question over HTTP and its answer */
  constructor(clock: ClockSync, ask: () => Promise<ClockProbe>) {
    this.#clock = clock;
    this.#ask = ask;
  }

  /** Begin, or begin anew with many: the page has connected or has slept. */
  begin(): void {
    this.#count = 0;
    clearTimeout(this.#timer);
    if (!this.#asking) this.#next(EAGER_INTERVAL_S);
  }

  close(): void {
    this.#closed = true;
    clearTimeout(this.#timer);
  }

  #next(pause: number): void {
    if (!this.#closed) this.#timer = setTimeout(() => void this.#probe(), pause * 1000);
  }

  async #probe(): Promise<void> {
    this.#asking = true;
    try {
      if (this.#clock.ready && this.#clock.roundTrip > FAR_ROUND_TRIP_S) {
        this.#clock.add(await this.#ask());
        this.#count += 1;
      }
    } catch {
      // A server that does not answer is told of by the stream.
    }
    this.#asking = false;
    this.#next(this.#count < EAGER ? EAGER_INTERVAL_S : INTERVAL_S);
  }
}
