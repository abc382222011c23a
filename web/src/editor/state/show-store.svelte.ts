import { ProblemError, type ReinaApi } from "../../connection";
import type { ShowState } from "../../generated/protocol";
import type { ShowEdited } from "../../generated/show";
import { withEdits, withTracks, type Edit } from "./edits";
import type { ShowDocument, ShowTrack } from "./show-document";
import type { TimeAxis } from "./time-axis";
import { does } from "../../words/editor-does/en";

export type SaveState = "saved" | "saving" | "failed";

/** What a store needs of what is around it. */
export interface StoreSurroundings {
  readonly api: Pick<ReinaApi, "request" | "sessionPath">;
  readonly session: string;
  /** What changes the session; null where this browser may only watch. */
  readonly token: string | null;
  /** How the music's time runs. */
  axis(): TimeAxis;
  /** Show what went wrong. */
  tell(error: unknown): void;
  /** Say something in passing. */
  word(title: string, detail?: string): void;
  /** After so many milliseconds, for another try. */
  later(action: () => void, milliseconds: number): void;
}

/** What the stream says of a change. */
type Told = ShowState & { readonly path?: string | null };

/** One step that waits to be saved. */
type Step =
  | { readonly kind: "edits"; readonly says: string; readonly edits: readonly Edit[] }
  | { readonly kind: "undo" | "redo" }
  | { readonly kind: "put"; readonly says: string; readonly document: unknown };

const RETRY_MS = [1000, 2000, 5000, 10_000];

/**
 * The open session's show as the server holds it, and the steps that it has not answered yet.
 *
 * Each step is one request and one step to undo. They are sent in their order, each on the state that the one before
 * left; until the answer comes the page shows the show with the edits already made. A write that comes too late is made
 * again on what the show has become; what cannot be made is told, and nothing else is lost with it.
 */
export class ShowStore {
  readonly #around: StoreSurroundings;
  /** The show as the server has said it last. */
  #held = $state.raw<ShowDocument | null>(null);
  #etag: string | null = null;
  #revision = -1;
  #waiting = $state.raw<readonly Step[]>([]);
  #working = false;
  #tries = 0;
  /** What the stream has told of last, while a request was under way. */
  #told: Told | null = null;

  saving = $state<SaveState>("saved");
  /** How many steps this page has made, undone or done again. */
  made = $state(0);
  undoSteps = $state(0);
  redoSteps = $state(0);

  constructor(around: StoreSurroundings) {
    this.#around = around;
  }

  /** The show with all that waits to be saved; null until it has been read. */
  readonly document: ShowDocument | null = $derived.by(() => {
    let document = this.#held;
    for (const step of this.#waiting) {
      if (document !== null && step.kind === "edits") document = withEdits(document, step.edits, this.#around.axis());
    }
    return document;
  });

  get editable(): boolean {
    return this.#around.token !== null && this.#held !== null;
  }

  /** The validator of what the server holds, as far as this page knows. */
  get etag(): string | null {
    return this.#etag;
  }

  /** How many steps wait for the server. */
  get waiting(): number {
    return this.#waiting.length;
  }

  /** Read the whole show: when it is opened, and when the stream has been lost and found. */
  async read(): Promise<void> {
    try {
      await this.#read();
    } catch (error) {
      this.#around.tell(error);
    }
  }

  /** Make edits as one step. `says` names it where it cannot be made. */
  edit(says: string, edits: readonly Edit[]): void {
    if (edits.length > 0) this.#add({ kind: "edits", says, edits });
  }

  undo(): void {
    if (this.undoSteps > 0 || this.#waiting.length > 0) this.#add({ kind: "undo" });
  }

  redo(): void {
    if (this.redoSteps > 0) this.#add({ kind: "redo" });
  }

  /** Another show in place of this one. */
  put(says: string, document: unknown): void {
    this.#add({ kind: "put", says, document });
  }

  /** Try again to save what could not be saved. */
  retry(): void {
    if (this.saving !== "failed") return;
    this.saving = "saving";
    void this.#work();
  }

  /** The stream says that the show changed, here or elsewhere. */
  follow(state: Told): Promise<void> {
    // A message that was overtaken by an answer says nothing new.
    if (state.revision >= this.#revision) this.#told = state;
    return this.#work();
  }

  #add(step: Step): void {
    if (!this.editable) return;
    this.made += 1;
    this.#waiting = [...this.#waiting, step];
    if (this.saving === "failed") return;
    this.saving = "saving";
    void this.#work();
  }

  /** Do what is to be done, one thing after another: take in what the stream has told of, then send what waits. */
  async #work(): Promise<void> {
    if (this.#working) return;
    this.#working = true;
    try {
      for (;;) {
        const told = this.#told;
        const step = this.#waiting[0];
        this.#told = null;
        if (told !== null) await this.#follow(told);
        else if (step === undefined || this.saving === "failed") break;
        else if (await this.#send(step)) this.#tries = 0;
      }
      if (this.saving === "saving") this.saving = "saved";
    } finally {
      this.#working = false;
    }
  }

  async #follow(told: Told): Promise<void> {
    if (told.etag === this.#etag) {
      this.#count(told);
      return;
    }
    try {
      await this.#take(told);
    } catch (error) {
      this.#around.tell(error);
    }
  }

  /** Send one step; returns whether it is done with. */
  async #send(step: Step): Promise<boolean> {
    try {
      await this.#request(step);
      return true;
    } catch (error) {
      if (!(error instanceof ProblemError)) throw error;
      if (error.isStale) return this.#sendAnew(step);
      if (error.status === 0 || error.status >= 500 || error.status === 429) {
        this.#wait();
        return false;
      }
      this.#drop();
      // What cannot be undone twice over is no news.
      if (error.status !== 409 || step.kind === "edits") this.#around.tell(error);
      await this.#readQuietly();
      return true;
    }
  }

  /** Somebody else was first: what they did is read, and the step is made on top of it. */
  async #sendAnew(step: Step): Promise<boolean> {
    try {
      await this.#read();
      if (!("says" in step)) {
        this.#drop();
        this.#around.word(does.justChanged, does.pressAgain);
      } else {
        this.#around.word(does.elseEdited, does.madeOnTop({ step: step.says }));
      }
      return true;
    } catch (error) {
      if (!(error instanceof ProblemError)) throw error;
      this.#wait();
      return false;
    }
  }

  async #request(step: Step): Promise<void> {
    const { api, session, token } = this.#around;
    const options = {
      ...(token === null ? {} : { token }),
      ...(this.#etag === null ? {} : { ifMatch: this.#etag }),
    };
    if (step.kind === "put") {
      const response = await api.request("PUT", api.sessionPath(session, "show"), { ...options, json: step.document });
      const document = (await response.json()) as ShowDocument;
      this.#hold(document, response.headers.get("ETag"), this.#waiting.slice(1));
      this.#count(await this.#readCounts());
      return;
    }
    const edits = step.kind === "edits" ? { json: step.edits } : {};
    const response = await api.request("POST", api.sessionPath(session, `show/${step.kind}`), { ...options, ...edits });
    const edited = (await response.json()) as ShowEdited;
    if (this.#held === null) return;
    const changed = edited.tracks as readonly ShowTrack[];
    const { tracks } = withTracks(this.#held, changed, edited.removed);
    this.#hold({ ...(edited.head as ShowDocument), tracks }, edited.etag, this.#waiting.slice(1));
    this.#count(edited);
  }

  /** Take in a state that somebody else's edit has led to. */
  async #take(state: Told): Promise<void> {
    const { api, session } = this.#around;
    const { path = null } = state;
    if (path === null || this.#held === null || state.revision !== this.#revision + 1) return this.#read();
    const address = api.sessionPath(session, `show/tracks/${path.split("/").map(encodeURIComponent).join("/")}`);
    try {
      const track = (await (await api.request("GET", address)).json()) as ShowTrack;
      this.#hold(withTracks(this.#held, [track], []), state.etag, this.#waiting);
    } catch (error) {
      if (!(error instanceof ProblemError && error.isUnknown)) throw error;
      this.#hold(withTracks(this.#held, [], [path]), state.etag, this.#waiting);
    }
    this.#count(state);
  }

  async #read(): Promise<void> {
    const { api, session } = this.#around;
    // Both at once, so that nobody sees a show whose steps to undo are not known yet.
    const [response, counts] = await Promise.all([
      api.request("GET", api.sessionPath(session, "show")),
      this.#readCounts(),
    ]);
    this.#hold((await response.json()) as ShowDocument, response.headers.get("ETag"), this.#waiting);
    this.#count(counts);
  }

  async #readQuietly(): Promise<void> {
    try {
      await this.#read();
    } catch {
      // The next answer or message brings it.
    }
  }

  async #readCounts(): Promise<ShowState> {
    const { api, session } = this.#around;
    const response = await api.request("GET", api.sessionPath(session, "show/history"));
    return (await response.json()) as ShowState;
  }

  #hold(document: ShowDocument, etag: string | null, waiting: readonly Step[]): void {
    this.#held = document;
    this.#etag = etag;
    this.#waiting = waiting;
  }

  #count(state: ShowState): void {
    if (state.etag !== this.#etag) return;
    this.#revision = state.revision;
    this.undoSteps = state.undo;
    this.redoSteps = state.redo;
  }

  #drop(): void {
    this.#waiting = this.#waiting.slice(1);
  }

  #wait(): void {
    this.saving = "failed";
    const pause = RETRY_MS[Math.min(this.#tries, RETRY_MS.length - 1)] ?? 1000;
    this.#tries += 1;
    this.#around.later(() => this.retry(), pause);
  }
}
