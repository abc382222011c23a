import { GivenUpError, type ProblemError } from "../connection";

/** How long a server is left alone that does not say for how long, seconds, and the least and the most. */
const USUAL_S = 5;
const LEAST_S = 1;
const MOST_S = 60;
const TICK_MS = 250;
/** What is asked again may be refused again: what is said of it stays for so long. */
const GRACE_S = 1.5;

interface Waiter {
  readonly due: number;
  again(): void;
  giveUp(reason: Error): void;
}

/** What waits for a busy server, and is asked again by itself. */
export class Patience {
  /** What the server said last, while anything waits or is just asked again; null otherwise. */
  title = $state<string | null>(null);
  /** Until it is asked again, whole seconds; 0 while it is asked. */
  secondsLeft = $state(0);
  readonly #now: () => number;
  #waiters: readonly Waiter[] = [];
  #ticking: ReturnType<typeof setInterval> | undefined;
  #quietSince = 0;

  /** @param now a clock in seconds, for tests */
  constructor(now: () => number = () => performance.now() / 1000) {
    this.#now = now;
  }

  /**
   * Wait for as long as the server asks for.
   *
   * @throws GivenUpError when the person does not want to wait, and the signal's reason when it ends what waits
   */
  wait({ title, retryAfter }: ProblemError, signal?: AbortSignal): Promise<void> {
    signal?.throwIfAborted();
    const pause = Math.min(Math.max(retryAfter ?? USUAL_S, LEAST_S), MOST_S);
    this.title = title;
    return new Promise((resolve, reject) => {
      const abort = (): void => this.#end(waiter, () => reject(signal?.reason as Error));
      const waiter: Waiter = {
        due: this.#now() + pause,
        again: () => this.#end(waiter, resolve),
        giveUp: (reason) => this.#end(waiter, () => reject(reason)),
      };
      signal?.addEventListener("abort", abort, { once: true });
      this.#waiters = [...this.#waiters, waiter];
      this.#ticking ??= setInterval(() => this.#tick(), TICK_MS);
      this.#count();
    });
  }

  /** Ask again without waiting any longer. */
  tryNow(): void {
    for (const waiter of this.#waiters) waiter.again();
  }

  /** Give up what waits. */
  cancel(): void {
    for (const waiter of this.#waiters) waiter.giveUp(new GivenUpError());
    this.#rest();
  }

  #end(waiter: Waiter, settle: () => void): void {
    if (!this.#waiters.includes(waiter)) return;
    this.#waiters = this.#waiters.filter((each) => each !== waiter);
    settle();
    if (this.#waiters.length === 0) this.#quietSince = this.#now();
    this.#count();
  }

  #tick(): void {
    const now = this.#now();
    for (const waiter of this.#waiters) if (waiter.due <= now) waiter.again();
    this.#count();
    if (this.#waiters.length === 0 && now - this.#quietSince >= GRACE_S) this.#rest();
  }

  #count(): void {
    const next = Math.min(...this.#waiters.map(({ due }) => due));
    this.secondsLeft = Number.isFinite(next) ? Math.max(Math.ceil(next - this.#now()), 0) : 0;
  }

  #rest(): void {
    clearInterval(this.#ticking);
    this.#ticking = undefined;
    this.title = null;
  }
}
