import { GivenUpError, ProblemError } from "../connection";
import { told } from "../words/told/en";

/** A way on from a notice: a button beside its words. */
export interface NoticeAction {
  readonly label: string;
  run(): unknown;
}

/** Something the person should know. */
export interface Notice {
  readonly id: number;
  /** What went wrong and what is asked stay until they are answered or over; a word passes. */
  readonly kind: "problem" | "question" | "word";
  readonly title: string;
  readonly detail: string;
  readonly lines: readonly string[];
  readonly actions: readonly NoticeAction[];
  /** Whether what it is about is past. */
  readonly over: () => boolean;
}

/** What a notice may have beside its words. */
export interface NoticeOptions {
  readonly lines?: readonly string[];
  readonly actions?: readonly NoticeAction[];
  readonly over?: () => boolean;
}

const never = (): boolean => false;

/** What the page has to say: one thing at a time, the latest, until it is answered, over or dismissed. */
export class Notices {
  current = $state.raw<Notice | null>(null);
  #next = 0;
  /** What is shown is that the server did not answer. */
  #unanswered = false;

  /** What is shown stays until it is answered. */
  get waits(): boolean {
    return this.current !== null && this.current.kind !== "word";
  }

  say(kind: Notice["kind"], title: string, detail = "", options: NoticeOptions = {}): void {
    const { lines = [], actions = [], over = never } = options;
    this.#unanswered = false;
    this.current = { id: this.#next++, kind, title, detail, lines, actions, over };
  }

  /** Show what went wrong in the words that came with it. */
  tell(error: unknown): void {
    if (error instanceof GivenUpError) return;
    if (error instanceof ProblemError) {
      const lines = error.errors.map(({ location, detail }) => (location === null ? detail : `${location}: ${detail}`));
      this.say("problem", error.title, error.detail, { lines });
      this.#unanswered = error.isUnanswered;
    } else if (error instanceof SyntaxError) {
      this.say("problem", told.notJson, error.message);
    } else {
      this.say("problem", told.pageFault, error instanceof Error ? error.message : String(error));
    }
  }

  /** The server answers (again): that it did not is past. */
  answered(): void {
    if (this.#unanswered) this.clear();
  }

  /** Put a notice away, where it still stands. */
  dismiss(id: number): void {
    if (this.current?.id === id) this.clear();
  }

  clear(): void {
    this.#unanswered = false;
    this.current = null;
  }
}
