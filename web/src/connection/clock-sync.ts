/** One ping and its pong: both in seconds, on the page's clock and on the server's. */
export interface ClockProbe {
  readonly sentAt: number;
  readonly receivedAt: number;
  readonly serverTime: number;
}

/** A round trip over this says nothing about the clocks. */
const LONGEST_ROUND_TRIP_S = 2;
/** About as fast as two clocks come apart, seconds a second: a probe counts for less the older it is. */
const DRIFT = 30e-6;
/** A probe that contradicts what is known by more than this was answered on another clock. */
const CONTRADICTION_S = 0.005;
/** The time that is given out comes to a better estimate at this rate, too slow to be seen or heard. */
const STEERING = 0.03;
/** What is further off than this is not steered to: it is a jump, and so are the first estimates of all. */
const JUMP_S = 0.1;
const FIRST_PROBES = 8;

/**
 * The server's clock as the page sees it, from many probes.
 *
 * The ways there and back are looked at one by one: of each the quickest message in the window counts, and both least
 * delays are taken for the same (as NTP does with a probe's two ways). A probe whose ways both happen to be quick
 * need not come, so jitter of ±50 ms leaves an error of a few milliseconds where the quickest round trip leaves ten.
 * What no probe can show is a way there that is always slower than the way back: half their difference stays.
 *
 * A probe also bounds the offset for certain, as its server time lies between sending and receiving. One that
 * contradicts the estimate means that a clock has jumped (a laptop slept, a server was started again on another
 * machine): all before it is forgotten.
 */
export class ClockSync {
  readonly #window: ClockProbe[] = [];
  readonly #windowLength: number;
  #probes = 0;
  #doubted = false;
  #estimate = 0;
  #roundTrip = Infinity;
  /** What was given out at a time of the page's clock; from there it goes towards the estimate. */
  #given = 0;
  #givenAt = 0;

  /** @param windowLength how many probes are remembered */
  constructor(windowLength = 240) {
    this.#windowLength = windowLength;
  }

  /** Take a probe in. Returns false when it is absurd (times out of order, not finite, far too slow) and was dropped. */
  add(probe: ClockProbe): boolean {
    const roundTrip = probe.receivedAt - probe.sentAt;
    if (!(roundTrip >= 0 && roundTrip <= LONGEST_ROUND_TRIP_S && Number.isFinite(probe.serverTime))) return false;
    if (this.#contradicts(probe)) {
      this.#window.length = 0;
      this.#probes = 0;
    }
    this.#doubted = false;
    this.#window.push(probe);
    if (this.#window.length > this.#windowLength) this.#window.shift();
    this.#probes += 1;
    const given = this.#givenOffset(probe.receivedAt);
    this.#weigh(probe.receivedAt);
    const jumps = this.#probes <= FIRST_PROBES || Math.abs(this.#estimate - given) > JUMP_S;
    this.#given = jumps ? this.#estimate : given;
    this.#givenAt = probe.receivedAt;
    return true;
  }

  /** Whether the clock is known: a probe has come back, and none is awaited that may say that it is another clock. */
  get ready(): boolean {
    return this.#window.length > 0 && !this.#doubted;
  }

  /** There may be another clock: a server that was started again counts from its own beginning. The next probe says. */
  doubt(): void {
    this.#doubted = true;
  }

  /** Seconds to add to the page's clock to get the server's, as far as is known; 0 until the first probe. */
  get offset(): number {
    return this.#estimate;
  }

  /** The least round trip, seconds: both ways' quickest messages. The offset is off by at most half of it. */
  get roundTrip(): number {
    return this.#roundTrip;
  }

  /** The server's time at a time of the page's clock, both in seconds; it never jumps by a small better knowledge. */
  serverTime(pageTime: number): number {
    return pageTime + this.#givenOffset(pageTime);
  }

  #weigh(now: number): void {
    const quickest = (way: (probe: ClockProbe) => number): number => {
      const aged = (probe: ClockProbe): number => way(probe) + DRIFT * (now - probe.receivedAt);
      return way(this.#window.reduce((best, each) => (aged(each) <= aged(best) ? each : best)));
    };
    const there = quickest(({ sentAt, serverTime }) => serverTime - sentAt);
    const back = quickest(({ receivedAt, serverTime }) => receivedAt - serverTime);
    this.#estimate = (there - back) / 2;
    this.#roundTrip = there + back;
  }

  #contradicts({ sentAt, receivedAt, serverTime }: ClockProbe): boolean {
    if (this.#window.length === 0) return false;
    const least = serverTime - receivedAt - CONTRADICTION_S;
    const most = serverTime - sentAt + CONTRADICTION_S;
    return this.#estimate < least || this.#estimate > most;
  }

  #givenOffset(pageTime: number): number {
    const missing = this.#estimate - this.#given;
    const steered = STEERING * Math.max(pageTime - this.#givenAt, 0);
    return this.#given + Math.sign(missing) * Math.min(Math.abs(missing), steered);
  }
}
