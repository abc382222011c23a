import type { ClockProbe, ClockSync } from "./clock-sync";

/** Over a shorter round trip than this the stream's own probes are exact enough. */
const FAR_ROUND_TRIP_S = 0.01;
/** Each way's quickest message is off by the jitter over their number: of these, by under 2 ms where it is ±50. */
const EAGER = 60;
const EAGER_INTERVAL_S = 0.1;
const INTERVAL_S = 1;
/** Asked at the same time, so that a long way does not make for few. */
const CHAINS = 2;

/**
 * Probes of the clock beside the stream, behind a slow network.
 *
 * TCP keeps its order: on the stream each pong waits for the frames before it, whichever of them takes longest, and
 * so comes later than any ping goes, by 20 ms where jitter is 50. On a connection of their own the two ways are alike.
 */
export class QuietProbes {
  readonly #clock: ClockSync;
  readonly #ask: (number: number) => Promise<ClockProbe>;
  #asked = 0;
  #count = 0;
  #closed = false;
  readonly #timers = new Map<number, ReturnType<typeof setTimeout>>();

  /** @param ask one question over HTTP and its answer; numbered, so that none is taken for another */
  constructor(clock: ClockSync, ask: (number: number) => Promise<ClockProbe>) {
    this.#clock = clock;
    this.#ask = ask;
  }

  /** Begin, or begin anew with many: the page has connected or has slept. */
  begin(): void {
    const idle = this.#count >= EAGER || this.#timers.size === 0;
    this.#count = 0;
    if (idle) for (let chain = 0; chain < CHAINS; chain++) this.#next(chain, EAGER_INTERVAL_S);
  }

  close(): void {
    this.#closed = true;
    for (const timer of this.#timers.values()) clearTimeout(timer);
  }

  #next(chain: number, pause: number): void {
    if (this.#closed) return;
    clearTimeout(this.#timers.get(chain));
    this.#timers.set(
      chain,
      setTimeout(() => void this.#probe(chain), pause * 1000),
    );
  }

  async #probe(chain: number): Promise<void> {
    try {
      if (this.#clock.ready && this.#clock.roundTrip > FAR_ROUND_TRIP_S) {
        this.#clock.add(await this.#ask(this.#asked++));
        this.#count += 1;
      }
    } catch {
      // A server that does not answer is told of by the stream.
    }
    // One chain is enough once enough is known.
    if (this.#count < EAGER) this.#next(chain, EAGER_INTERVAL_S);
    else if (chain === 0) this.#next(chain, INTERVAL_S);
  }
}
