import { ProblemError, ReinaApi, type SessionFiles } from "../connection";
import type { Example, ShowParameter } from "../generated/protocol";
import { sortFiles, type SortedFiles } from "./dropped-files";
import { controlToken } from "../pieces/links";
import { SessionView } from "./session-view.svelte";
import { remember, remembered, rememberToken } from "./storage";

/** Something the person should know; it stays until it is put away or its time is over. */
export interface Notice {
  readonly id: number;
  readonly kind: "problem" | "word";
  readonly title: string;
  readonly detail: string;
  readonly lines: readonly string[];
}

export type Phase = "opening" | "open" | "unknown" | "failed";

const WORD_S = 6;
const SESSION_PATH = /^\/s\/([^/]+)\/?$/;

/** The page: which session is open, what is being done, what went wrong. */
export class Reina {
  readonly api: ReinaApi;
  view = $state.raw<SessionView | null>(null);
  phase = $state<Phase>("opening");
  /** What the page is busy with, in a few words; null when with nothing. */
  busy = $state<string | null>(null);
  notices = $state.raw<readonly Notice[]>([]);
  parameters = $state.raw<readonly ShowParameter[]>([]);
  examples = $state.raw<readonly Example[]>([]);
  volume = $state(remembered().volume);
  muted = $state(remembered().muted);
  hasPlayed = $state(remembered().hasPlayed);

  /** The score's file of each session that this page made, so that a song can be added to it. */
  readonly #scores: Record<string, File | undefined> = {};
  #nextNotice = 0;
  #opening = 0;

  constructor(api = new ReinaApi()) {
    this.api = api;
  }

  /** Open what the address says; `/` opens this browser's own session of the bundled piece. */
  async start(): Promise<void> {
    void this.#readLists();
    this.#takeControl();
    await this.openAddress(location.pathname);
  }

  async openAddress(path: string): Promise<void> {
    const id = SESSION_PATH.exec(path)?.[1];
    if (id !== undefined) await this.open(decodeURIComponent(id));
    else await this.#openHome();
  }

  /** Go to a session as a link does. */
  async goTo(id: string): Promise<void> {
    if (await this.open(id)) history.pushState(null, "", addressOf(id));
  }

  /** Go to this browser's own session of the bundled piece. */
  async goHome(): Promise<void> {
    remember({ home: null });
    history.pushState(null, "", `/${location.search}`);
    await this.#openHome();
  }

  /** Open a session that the server has, in place of the one that is open. */
  async open(id: string): Promise<boolean> {
    const opening = ++this.#opening;
    this.phase = "opening";
    try {
      const token = remembered().tokens[id] ?? null;
      const view = await SessionView.open(id, token, {
        api: this.api,
        tell: (error) => this.tell(error),
        gone: () => this.#lose("unknown"),
      });
      if (opening !== this.#opening) {
        void view.close();
        return false;
      }
      this.#enter(view);
      return true;
    } catch (error) {
      if (opening !== this.#opening) return false;
      const unknown = error instanceof ProblemError && error.isUnknown;
      this.#lose(unknown ? "unknown" : "failed");
      if (!unknown) this.tell(error);
      return false;
    }
  }

  /** Make a session of a bundled piece and go to it. */
  async openExample(example: Example): Promise<void> {
    await this.#make(`Opening ${example.title}`, async () => {
      const score = await this.api.file(example.score);
      const song = example.song === null ? {} : { song: await this.api.file(example.song) };
      const show = example.show === null ? {} : { show: await this.api.file(example.show) };
      return { score, ...song, ...show };
    });
  }

  /** Make of dropped or chosen files what can be made of them: a new session, a song or a show for the open one. */
  async openFiles(files: Iterable<File>): Promise<void> {
    const sorted = await sortFiles(files);
    if (sorted.unknown.length > 0) {
      this.problem(
        `${sorted.unknown.join(", ")} cannot be used`,
        "Drop a MIDI or JSON score, and an audio file if you have one.",
      );
    }
    const { score, song, show } = sorted;
    if (score !== null) await this.#make(`Reading ${score.name}`, () => withoutNull(score, sorted));
    else if (song !== null) await this.addSong(song);
    else if (show !== null) await this.putShow(show);
  }

  /** A new session of the open one's score with a recording. */
  async addSong(song: File): Promise<void> {
    const view = this.view;
    const score = view === null ? undefined : this.#scores[view.id];
    if (view === null || score === undefined) {
      this.problem("A recording needs its score", `Drop the MIDI or JSON score together with ${song.name}.`);
      return;
    }
    await this.#make(`Adding ${song.name}`, async () => {
      const show = new File([JSON.stringify(await this.#showDocument(view.id))], "show.json");
      return { score, song, show };
    });
  }

  /** Replace the open session's show. */
  async putShow(file: File): Promise<void> {
    const { id, token = null } = this.view ?? {};
    if (id === undefined || token === null) {
      this.problem("This session is not yours to change", "Drop a score first: that opens a session of your own.");
      return;
    }
    await this.attempt(`Reading ${file.name}`, async () => {
      const json: unknown = JSON.parse(await file.text());
      await this.api.request("PUT", this.api.sessionPath(id, "show"), { json, token });
      this.word(`The show ${file.name} is on.`);
    });
  }

  /** Play or pause, and remember that somebody found the way. */
  async toggle(): Promise<void> {
    if (!this.hasPlayed) {
      this.hasPlayed = true;
      remember({ hasPlayed: true });
    }
    await this.view?.toggle();
  }

  setVolume(volume: number, muted: boolean): void {
    this.volume = Math.min(Math.max(volume, 0), 1);
    this.muted = muted;
    this.view?.setVolume(this.volume, this.muted);
    remember({ volume: this.volume, muted });
  }

  /** Do something that takes a moment, and tell what goes wrong. Returns whether it went well. */
  async attempt(busy: string, action: () => Promise<void>): Promise<boolean> {
    this.busy = busy;
    try {
      await action();
      return true;
    } catch (error) {
      this.tell(error);
      return false;
    } finally {
      this.busy = null;
    }
  }

  /** Show what went wrong in the words that came with it. */
  tell(error: unknown): void {
    if (error instanceof ProblemError) {
      const lines = error.errors.map(({ location, detail }) => (location === null ? detail : `${location}: ${detail}`));
      this.problem(error.title, error.detail, lines);
    } else if (error instanceof SyntaxError) {
      this.problem("This is not JSON", error.message);
    } else {
      this.problem("Something went wrong in the page", error instanceof Error ? error.message : String(error));
    }
  }

  problem(title: string, detail: string, lines: readonly string[] = []): void {
    this.#notice({ kind: "problem", title, detail, lines });
  }

  /** Say something in passing. */
  word(title: string, detail = ""): void {
    const id = this.#notice({ kind: "word", title, detail, lines: [] });
    setTimeout(() => this.dismiss(id), WORD_S * 1000);
  }

  dismiss(id: number): void {
    this.notices = this.notices.filter((notice) => notice.id !== id);
  }

  #notice(notice: Omit<Notice, "id">): number {
    const id = this.#nextNotice++;
    const others = this.notices.filter(({ title, detail }) => title !== notice.title || detail !== notice.detail);
    this.notices = [...others.slice(-2), { ...notice, id }];
    return id;
  }

  async #readLists(): Promise<void> {
    const [parameters, examples] = await Promise.allSettled([this.api.parameters(), this.api.examples()]);
    if (parameters.status === "fulfilled") this.parameters = parameters.value;
    if (examples.status === "fulfilled") this.examples = examples.value;
  }

  async #openHome(): Promise<void> {
    const { home } = remembered();
    if (home !== null && (await this.open(home))) {
      history.replaceState(null, "", addressOf(home));
      return;
    }
    this.phase = "opening";
    this.notices = [];
    let first: Example | undefined;
    try {
      first = (await this.api.examples())[0];
    } catch (error) {
      this.#lose("failed");
      this.tell(error);
      return;
    }
    if (first === undefined) this.#lose("failed");
    else {
      await this.openExample(first);
      if (this.view !== null) remember({ home: this.view.id });
    }
  }

  async #make(busy: string, files: () => SessionFiles | Promise<SessionFiles>): Promise<void> {
    const wasHome = SESSION_PATH.exec(location.pathname) === null;
    await this.attempt(busy, async () => {
      const given = await files();
      const made = await this.api.createSession(given);
      rememberToken(made.id, made.control_token);
      this.#scores[made.id] = given.score;
      if (wasHome) history.replaceState(null, "", addressOf(made.id));
      else history.pushState(null, "", addressOf(made.id));
      await this.open(made.id);
    });
    if (this.view === null && this.phase === "opening") this.phase = "failed";
  }

  async #showDocument(id: string): Promise<unknown> {
    return (await this.api.request("GET", this.api.sessionPath(id, "show"))).json();
  }

  /** Keep the token of a link that gives control, and take it out of sight. */
  #takeControl(): void {
    const id = SESSION_PATH.exec(location.pathname)?.[1];
    const token = controlToken(location.hash);
    if (id === undefined || token === null) return;
    rememberToken(decodeURIComponent(id), token);
    history.replaceState(null, "", location.pathname + location.search);
  }

  #enter(view: SessionView): void {
    void this.view?.close();
    this.view = view;
    this.phase = "open";
    view.setVolume(this.volume, this.muted);
    document.title = `${view.session.title} · Reina`;
    const { pieces } = remembered();
    if (view.canControl) {
      remember({ pieces: { ...pieces, [view.id]: { title: view.session.title, opened: Date.now() } } });
    }
  }

  #lose(phase: "unknown" | "failed"): void {
    void this.view?.close();
    this.view = null;
    this.phase = phase;
    document.title = "Reina";
  }
}

/** A session's address in the browser; what the address asks for beside it (`?tier=`) stays. */
function addressOf(id: string): string {
  return `/s/${encodeURIComponent(id)}${location.search}`;
}

function withoutNull(score: File, { song, show }: SortedFiles): SessionFiles {
  return { score, ...(song === null ? {} : { song }), ...(show === null ? {} : { show }) };
}
