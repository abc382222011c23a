/** One ping and its pong: both in seconds, on the page's clock and on the server's. */
export interface ClockProbe {
  readonly sentAt: number;
  readonly receivedAt: number;
  readonly serverTime: number;
}

/** A round trip over this says nothing about the clocks. */
const LONGEST_ROUND_TRIP_S = 2;

/**
 * The server's clock as the page sees it, from the probe of the smallest round trip in a sliding window.
 *
 * A pong carries the server's time at some moment between sending and receiving; taking the middle is off by at most
 * half the round trip, so the quickest probe is the best one (Cristian, "Probabilistic clock synchronization", 1989).
 */
export class ClockSync {
  readonly #window: ClockProbe[] = [];
  readonly #windowLength: number;
  #best: ClockProbe | null = null;
  #stale = false;

  /** @param windowLength how many probes are remembered; older ones are forgotten, so that a drifting clock is followed */
  constructor(windowLength = 16) {
    this.#windowLength = windowLength;
  }

  /** Take a probe in. Returns false when it is absurd (times out of order, not finite, far too slow) and was dropped. */
  add(probe: ClockProbe): boolean {
    const roundTrip = probe.receivedAt - probe.sentAt;
    if (!(roundTrip >= 0 && roundTrip <= LONGEST_ROUND_TRIP_S && Number.isFinite(probe.serverTime))) return false;
    if (this.#stale) this.#window.length = 0;
    this.#stale = false;
    this.#window.push(probe);
    if (this.#window.length > this.#windowLength) this.#window.shift();
    this.#best = this.#window.reduce((best, each) => (roundTripOf(each) <= roundTripOf(best) ? each : best));
    return true;
  }

  /** Whether a probe has come back yet. */
  get ready(): boolean {
    return this.#best !== null;
  }

  /** Seconds to add to the page's clock to get the server's; 0 until the first probe. */
  get offset(): number {
    const best = this.#best;
    return best === null ? 0 : best.serverTime - (best.sentAt + best.receivedAt) / 2;
  }

  /** Round trip of the probe that the offset rests on, seconds; the offset is off by at most half of it. */
  get roundTrip(): number {
    return this.#best === null ? Infinity : roundTripOf(this.#best);
  }

  /** The server's time at a time of the page's clock, both in seconds. */
  serverTime(pageTime: number): number {
    return pageTime + this.offset;
  }

  /** Forget what is known as soon as a new probe comes, as after a reconnection (the server may be another one). */
  reset(): void {
    this.#stale = true;
  }
}

function roundTripOf(probe: ClockProbe): number {
  return probe.receivedAt - probe.sentAt;
}
