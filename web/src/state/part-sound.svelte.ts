import { AS_WRITTEN, MOST_SEMITONES, type Hearing } from "../sound/hearing";
import { pageStorage } from "./storage";

const KEY = "reina-part-sound";
/** So many sessions are remembered, the latest ones. */
const MOST_KEPT = 50;

interface Kept {
  readonly balance: number;
  readonly semitones: number;
}

const NOTHING: Kept = { balance: 0, semitones: 0 };

/** How this page hears the followed player's part, and how high everything: the person's own, kept for each session. */
export class PartSound {
  /** From -1, without the part, over 0, as written, to 1, the part alone. */
  balance = $state(0);
  /** By how much all but the drums sounds higher. */
  semitones = $state(0);
  readonly #session: string;
  readonly #storage: Pick<Storage, "getItem" | "setItem"> | null;
  /** Once told apart, the part stays so: to go back and forth costs nothing then. */
  #apart = false;

  constructor(session: string, storage: Pick<Storage, "getItem" | "setItem"> | null = pageStorage()) {
    this.#session = session;
    this.#storage = storage;
    const { balance, semitones } = this.#read()[session] ?? NOTHING;
    this.balance = within(balance, 1);
    this.semitones = Math.round(within(semitones, MOST_SEMITONES));
  }

  /** Hear it otherwise. */
  choose(change: Partial<Kept>): void {
    if (change.balance !== undefined) this.balance = within(change.balance, 1);
    if (change.semitones !== undefined) this.semitones = within(change.semitones, MOST_SEMITONES);
    const others = Object.entries(this.#read()).filter(([session]) => session !== this.#session);
    const own: Kept = { balance: this.balance, semitones: this.semitones };
    const kept = Object.fromEntries([...others.slice(1 - MOST_KEPT), [this.#session, own]]);
    try {
      this.#storage?.setItem(KEY, JSON.stringify(kept));
    } catch {
      // Full or forbidden: it is forgotten with the page.
    }
  }

  /** What the page has to have of a song of which this player is followed. */
  hearing(player: number): Hearing {
    this.#apart ||= this.balance !== 0;
    const { semitones } = this;
    return this.#apart ? { apart: true, player, semitones } : { ...AS_WRITTEN, semitones };
  }

  /** Back to what everybody hears, as where the server cannot make anything else. */
  giveUp(): void {
    this.#apart = false;
    this.choose(NOTHING);
  }

  #read(): Record<string, Kept> {
    try {
      return JSON.parse(this.#storage?.getItem(KEY) ?? "{}") as Record<string, Kept>;
    } catch {
      return {};
    }
  }
}

function within(value: number, most: number): number {
  return Number.isFinite(value) ? Math.min(Math.max(value, -most), most) : 0;
}
