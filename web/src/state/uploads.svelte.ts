import { GivenUpError, ProblemError, type Sending } from "../connection";

/**
 * How far an upload is: it is on its way, the server works at what came, or it did not get there and can be sent
 * again.
 */
export type UploadPhase = "sending" | "reading" | "failed";

/** One upload that somebody waits for. */
export class Upload {
  /** What is sent, in the files' names. */
  readonly name: string;
  phase = $state<UploadPhase>("sending");
  /** Bytes that have left, and of how many; 0 of 0 before the first. */
  sent = $state(0);
  of = $state(0);
  /** Why it did not get there. */
  problem = $state.raw<ProblemError | null>(null);
  /** Rejects once it is given up. */
  readonly givenUp: Promise<never>;
  #abort = new AbortController();
  #isGivenUp = false;
  #giveUp: (reason: GivenUpError) => void = () => undefined;
  #sendAgain: () => void = () => undefined;

  constructor(name: string) {
    this.name = name;
    this.givenUp = new Promise((_, reject) => (this.#giveUp = reject));
    // It is awaited beside what it ends; where nothing ends nobody asks.
    this.givenUp.catch(() => undefined);
  }

  /** The share of it that has left, 0…1. */
  get share(): number {
    return this.of === 0 ? 0 : Math.min(this.sent / this.of, 1);
  }

  get isGivenUp(): boolean {
    return this.#isGivenUp;
  }

  /** A try, the first or another. */
  begin(): Sending {
    this.#abort = new AbortController();
    this.problem = null;
    this.phase = "sending";
    this.sent = 0;
    return {
      signal: this.#abort.signal,
      sent: (bytes, of) => {
        this.sent = bytes;
        this.of = of;
        this.phase = bytes < of ? "sending" : "reading";
      },
    };
  }

  /** It did not get there: wait until it is to be sent again. */
  failed(problem: ProblemError): Promise<void> {
    this.problem = problem;
    this.phase = "failed";
    return new Promise((resolve) => (this.#sendAgain = resolve));
  }

  /** Send the same again, after a failure. */
  sendAgain(): void {
    this.#sendAgain();
  }

  /** Give it up, at once. */
  cancel(): void {
    if (this.#isGivenUp) return;
    this.#isGivenUp = true;
    this.#giveUp(new GivenUpError());
    // What has come whole is worked at already: its answer says what there is to take back.
    if (this.phase !== "reading") this.#abort.abort(new GivenUpError());
  }
}

/** What is uploaded at present, and what did not get there yet. */
export class Uploads {
  all = $state.raw<readonly Upload[]>([]);

  /**
   * Send something, as often as the person wants it where the server is away or busy.
   *
   * @param name what is sent, in the files' names
   * @param task sends it
   * @param takeBack ends what the server has made of it although it was given up
   * @param signal gives it up
   * @throws GivenUpError when it is given up, ProblemError when the server refuses it for good
   */
  async run<T>(
    name: string,
    task: (sending: Sending) => Promise<T>,
    { takeBack, signal }: { takeBack?: (made: T) => unknown; signal?: AbortSignal } = {},
  ): Promise<T> {
    const upload = new Upload(name);
    const cancel = (): void => upload.cancel();
    signal?.addEventListener("abort", cancel);
    if (signal?.aborted === true) cancel();
    this.all = [...this.all, upload];
    try {
      for (;;) {
        try {
          return await Promise.race([this.#try(upload, task, takeBack), upload.givenUp]);
        } catch (error) {
          const passing = error instanceof ProblemError && error.isPassing;
          if (upload.isGivenUp || !passing) throw error;
          await Promise.race([upload.failed(error), upload.givenUp]);
        }
      }
    } finally {
      signal?.removeEventListener("abort", cancel);
      this.all = this.all.filter((each) => each !== upload);
    }
  }

  /** Give up what was begun last; returns whether there was anything. */
  cancelLast(): boolean {
    const last = this.all.at(-1);
    last?.cancel();
    return last !== undefined;
  }

  async #try<T>(upload: Upload, task: (sending: Sending) => Promise<T>, takeBack?: (made: T) => unknown): Promise<T> {
    const made = await task(upload.begin());
    if (upload.isGivenUp) takeBack?.(made);
    return made;
  }
}
