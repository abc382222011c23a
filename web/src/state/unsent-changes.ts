import { ProblemError } from "../connection";
import { sending } from "../words/sending/en";
import type { Notices } from "./notices.svelte";

/** Changes that did not get to the server: they are told, all of them, until they are sent again or put away. */
export class UnsentChanges {
  readonly #notices: Notices;
  #again: (() => unknown)[] = [];
  #notice: number | null = null;

  constructor(notices: Notices) {
    this.#notices = notices;
  }

  /**
   * Tell that something was not changed; what was refused for good is told as it is.
   *
   * @param again makes the same change once more
   * @param over whether nobody can want it any more
   */
  tell(error: unknown, again: () => unknown, over: () => boolean): void {
    if (!(error instanceof ProblemError && error.isPassing)) {
      this.#notices.tell(error);
      return;
    }
    if (this.#notices.current?.id !== this.#notice) this.#again = [];
    this.#again.push(again);
    const count = this.#again.length;
    this.#notices.say("problem", sending.notChanged({ count }), `${error.title}. ${sending.asBefore}`, {
      actions: [{ label: sending.sendAgain, run: () => this.#sendAgain() }],
      over,
    });
    this.#notice = this.#notices.current?.id ?? null;
  }

  #sendAgain(): void {
    const changes = this.#again;
    this.#again = [];
    for (const again of changes) again();
  }
}
