import type { ChartLine, WireNote } from "../generated/protocol";

type Asked = Pick<
  WireNote,
  "index" | "onset_s" | "duration_s" | "sounding_pitch" | "valves" | "usual_valves" | "written_name" | "sounding_name"
>;

/** A note whose fingering is asked for. */
export interface Question {
  readonly note: Asked;
  /** The fingerings that are right, the usual one first. */
  readonly accepted: readonly (readonly number[])[];
}

/** The usual fingering, another that the note has, or none of them. */
export type Verdict = "usual" | "alternate" | "wrong";

export interface Answered {
  readonly question: Question;
  readonly given: readonly number[];
  readonly verdict: Verdict;
}

/** So many other questions come before a note that was not known is asked for again. */
const ASKED_AGAIN_AFTER = 3;
/** How far behind its onset a note may still be fingered in time: seconds at the rate, and a share of its length. */
const GRACE_S = 0.25;
const GRACE_SHARE = 0.6;
/** What is pressed this long before a note counts for it, seconds at the rate. */
const AHEAD_S = 0.06;
const SAME_S = 1e-3;

function same(one: readonly number[], other: readonly number[]): boolean {
  return one.length === other.length && one.every((valve) => other.includes(valve));
}

/** What an answer is worth, valves that are down in any order. */
export function judge({ accepted }: Question, given: readonly number[]): Verdict {
  const place = accepted.findIndex((fingering) => same(fingering, given));
  return place < 0 ? "wrong" : place === 0 ? "usual" : "alternate";
}

/**
 * What a stretch of a part asks for: each note whose fingering is not the one before repeated.
 *
 * @param line the notes that are played, one at a time.
 * @param chart of the instrument, for what else is right.
 */
export function questionsOf(
  line: readonly Asked[],
  chart: readonly ChartLine[],
  { start, end }: { readonly start: number; readonly end: number },
): readonly Question[] {
  const within = line.filter(({ onset_s }) => onset_s >= start - SAME_S && onset_s < end - SAME_S);
  const another = within.filter((note, at) => note.sounding_pitch !== within[at - 1]?.sounding_pitch);
  return another.map((note) => {
    const known = chart.find(({ sounding_pitch }) => sounding_pitch === note.sounding_pitch)?.fingerings ?? [];
    const all = [note.usual_valves, ...known, note.valves].filter((valves) => valves !== null);
    const accepted = all.filter((valves, at) => all.findIndex((each) => same(each, valves)) === at);
    return { note, accepted };
  });
}

/** The song time within which a note is fingered in time, seconds. */
export function timeFor({ note }: Question, rate: number): { readonly from: number; readonly until: number } {
  const grace = Math.min(GRACE_S * rate, GRACE_SHARE * note.duration_s);
  return { from: note.onset_s - AHEAD_S * rate, until: note.onset_s + grace };
}

/** Asks for fingerings one after another, and counts. */
export class Quiz {
  /** How many different notes are asked for. */
  readonly total: number;
  /** What is asked for; null at the end. */
  current = $state.raw<Question | null>(null);
  /** The answer before; null before the first. */
  last = $state.raw<Answered | null>(null);
  /** A wrong answer stands to be looked at, until it goes on. */
  shown = $state(false);
  /** Known at the first try. */
  right = $state(0);
  /** Not known at the first try. */
  missed = $state.raw<readonly Question[]>([]);
  #waiting: readonly Question[];
  readonly #repeats: boolean;

  /** @param repeats whether what was not known is asked for again. */
  constructor(questions: readonly Question[], { repeats }: { readonly repeats: boolean }) {
    this.total = questions.length;
    this.#waiting = questions;
    this.#repeats = repeats;
    this.#next();
  }

  /** How many different notes were answered. */
  get answered(): number {
    return this.right + this.missed.length;
  }

  /** Take an answer. What is right goes on at once, what is wrong once it was looked at; in time all goes on. */
  answer(given: readonly number[]): Verdict | null {
    const question = this.current;
    if (question === null || this.shown) return null;
    const verdict = judge(question, given);
    const again = this.missed.includes(question);
    this.last = { question, given: [...given].sort((a, b) => a - b), verdict };
    if (verdict !== "wrong") {
      if (!again) this.right += 1;
      this.#next();
      return verdict;
    }
    if (!again) this.missed = [...this.missed, question];
    if (this.#repeats) {
      const behind = Math.min(ASKED_AGAIN_AFTER, this.#waiting.length);
      this.#waiting = [...this.#waiting.slice(0, behind), question, ...this.#waiting.slice(behind)];
      this.shown = true;
    } else this.#next();
    return verdict;
  }

  /** Come to the end: what was not asked for is left out. */
  end(): void {
    this.#waiting = [];
    this.shown = false;
    this.current = null;
  }

  /** Go on from a wrong answer. */
  goOn(): void {
    if (!this.shown) return;
    this.shown = false;
    this.#next();
  }

  #next(): void {
    const [next, ...rest] = this.#waiting;
    this.current = next ?? null;
    this.#waiting = rest;
  }
}
