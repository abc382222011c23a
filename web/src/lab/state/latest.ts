/** Ask one question at a time: while one is under way, only the newest of those that come waits. */
export class Latest<Question, Answer> {
  readonly #ask: (question: Question) => Promise<Answer>;
  readonly #told: (answer: Answer, question: Question) => void;
  readonly #failed: (error: unknown) => void;
  #waiting: Question | null = null;
  #asking = false;
  #generation = 0;

  constructor(
    ask: (question: Question) => Promise<Answer>,
    told: (answer: Answer, question: Question) => void,
    failed: (error: unknown) => void,
  ) {
    this.#ask = ask;
    this.#told = told;
    this.#failed = failed;
  }

  /** Whether an answer is still to come. */
  get busy(): boolean {
    return this.#asking;
  }

  /** Ask, now or when the question before is answered. */
  put(question: Question): void {
    this.#waiting = question;
    if (!this.#asking) void this.#work();
  }

  /** Nothing that was asked before matters any more. */
  drop(): void {
    this.#waiting = null;
    this.#generation += 1;
  }

  async #work(): Promise<void> {
    this.#asking = true;
    while (this.#waiting !== null) {
      const question: Question = this.#waiting;
      const generation = this.#generation;
      this.#waiting = null;
      try {
        const answer = await this.#ask(question);
        if (generation === this.#generation) this.#told(answer, question);
      } catch (error) {
        if (generation === this.#generation) this.#failed(error);
      }
    }
    this.#asking = false;
  }
}
