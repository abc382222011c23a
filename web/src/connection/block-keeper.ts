import type { FrameBlocks } from "../generated/protocol";
import type { NeededBlock } from "./blocks-ahead";
import { ProblemError } from "./problem";

/** What is pushed, but is not here so long and two round trips before it is needed, is fetched, seconds. */
const LATE_S = 0.5;
/** What is pushed anew is given so long, and a round trip. */
const PATIENCE_S = 0.3;
/** A network that is slower than this counts as no slower. */
const LONGEST_WAY_S = 0.4;
/** Where nothing answers, or only by an error. */
const PAUSE_S = 1;
const AT_ONCE = 3;

/** What a keeper needs of the world around it. */
export interface BlockWorld {
  /** The page's clock, seconds. */
  now(): number;
  /** The bytes at an address; throws ProblemError. */
  get(href: string, signal: AbortSignal): Promise<ArrayBuffer>;
  /** Whether a block of the present revision is here. */
  has(number: number): boolean;
  /** Takes a block's bytes in. */
  take(bytes: ArrayBuffer): Promise<void>;
}

/** Fetches the blocks that are not pushed, and those that were lost on the way or come too late. */
export class BlockKeeper {
  readonly #world: BlockWorld;
  readonly #session: string;
  #blocks: FrameBlocks;
  /** What is on its way, and what ends it. */
  #fetching = new Set<number>();
  #wanted = new AbortController();
  /** The blocks' own origin failed: the session's has them too. */
  #fromSession = false;
  /** There is another revision, which will be told. */
  #outdated = false;
  #expectedFrom = -Infinity;
  #pausedUntil = -Infinity;

  /** @param session the session's address */
  constructor(session: string, blocks: FrameBlocks, world: BlockWorld) {
    this.#session = session;
    this.#blocks = blocks;
    this.#world = world;
  }

  /** The blocks are others, or elsewhere. */
  follow(blocks: FrameBlocks): void {
    this.close();
    this.#blocks = blocks;
    this.#fetching = new Set();
    this.#wanted = new AbortController();
    this.#fromSession = false;
    this.#outdated = false;
  }

  /** The server pushes anew what is needed now. */
  expect(): void {
    this.#expectedFrom = this.#world.now();
  }

  /**
   * Fetch what is missing and is not to be expected.
   *
   * @param roundTrip the network's, seconds; null while the stream is down
   */
  look(needed: readonly NeededBlock[], roundTrip: number | null): void {
    const { pushed } = this.#blocks;
    const now = this.#world.now();
    if (this.#outdated || now < this.#pausedUntil) return;
    const way = Math.min(roundTrip ?? 0, LONGEST_WAY_S);
    if (pushed && (roundTrip === null || now < this.#expectedFrom + PATIENCE_S + way)) return;
    for (const { number, comes } of needed) {
      if (this.#fetching.size >= AT_ONCE || (pushed && comes > LATE_S + 2 * way)) return;
      if (!this.#fetching.has(number) && !this.#world.has(number)) void this.#fetch(number);
    }
  }

  /** Nothing more is fetched. */
  close(): void {
    this.#wanted.abort();
    this.#outdated = true;
  }

  async #fetch(number: number): Promise<void> {
    const fetching = this.#fetching;
    const { signal } = this.#wanted;
    fetching.add(number);
    try {
      const bytes = await this.#get(number, signal);
      if (signal.aborted) return;
      await this.#world.take(bytes);
      if (!this.#world.has(number)) this.#pause();
    } catch (error) {
      if (signal.aborted) return;
      if (isOfAnother(error)) this.#outdated = true;
      else this.#pause();
    } finally {
      fetching.delete(number);
    }
  }

  #pause(): void {
    this.#pausedUntil = this.#world.now() + PAUSE_S;
  }

  async #get(number: number, signal: AbortSignal): Promise<ArrayBuffer> {
    const { href, revision } = this.#blocks;
    const own = `${this.#session}/blocks/${revision}`;
    if (!this.#fromSession && href !== own) {
      try {
        return await this.#world.get(`${href}/${number}`, signal);
      } catch (error) {
        if (signal.aborted || isOfAnother(error)) throw error;
        this.#fromSession = true;
      }
    }
    return await this.#world.get(`${own}/${number}`, signal);
  }
}

/** Whether the revision is another meanwhile. */
function isOfAnother(error: unknown): boolean {
  return error instanceof ProblemError && error.status === 410;
}
