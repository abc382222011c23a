import { GivenUpError, ProblemError, ReinaApi, type SessionFiles } from "../connection";
import type { CreatedSession, Example, InstrumentList, ShowParameter } from "../generated/protocol";
import { controlToken } from "../pieces/links";
import { audioLength } from "../sound";
import { namesOf, sortFiles } from "./dropped-files";
import { arrivalOf } from "./findings";
import { Notices, type NoticeOptions } from "./notices.svelte";
import { Patience } from "./patience.svelte";
import { PracticeChoices } from "./practice-choices.svelte";
import { removePoster } from "./pictures";
import { clockTime } from "./readout";
import { isFramed } from "./framed";
import { SessionView } from "./session-view.svelte";
import { SignInDesk } from "../signin/sign-in.svelte";
import { OutputLatency } from "../latency/output-latency.svelte";
import { remember, remembered, rememberToken } from "./storage";
import { transcribed } from "./transcribing";
import { UnsentChanges } from "./unsent-changes";
import { Uploads } from "./uploads.svelte";
import { told } from "../words/told/en";
import { transcribing } from "../words/transcribe/en";

/**
 * `ended` was open here, `guest` is somebody who would have to sign in, `busy` is a server that could not be waited for,
 * and `failed` anything else.
 */
export type Phase = "opening" | "open" | Absence;
/** Why there is no session. */
export type Absence = "unknown" | "ended" | "guest" | "busy" | "failed";

/** A recording is of a piece that is longer or shorter by this share at most, or by a lead-in and an end's. */
const ALIKE_SHARE = 0.15;
const ALIKE_S = 5;
/** How many files that were left aside get a button each. */
const OFFERED = 2;
const SESSION_PATH = /^\/s\/([^/]+)\/?$/;

/** The page: which session is open, what is being done, what went wrong. */
export class Reina {
  readonly api: ReinaApi;
  view = $state.raw<SessionView | null>(null);
  phase = $state<Phase>("opening");
  /** What the page is busy with, in a few words; null when with nothing. */
  busy = $state<string | null>(null);
  readonly notices = new Notices();
  readonly uploads = new Uploads();
  /** What waits for a busy server. */
  readonly patience = new Patience();
  readonly signIn: SignInDesk;
  readonly practice = new PracticeChoices();
  /** Called with the session of a score that was just uploaded. */
  arrived: ((view: SessionView) => void) | null = null;
  /** What a show can move, with the open session's own stances among the choices. */
  readonly parameters: readonly ShowParameter[] = $derived.by(() => {
    const own = (this.view?.session.stances ?? []).map(({ name }) => name);
    if (own.length === 0) return this.#listed;
    return this.#listed.map((each) =>
      each.path.endsWith("player/stance") ? { ...each, choices: [...each.choices, ...own] } : each,
    );
  });
  examples = $state.raw<readonly Example[]>([]);
  /** What a cast can be made of; null until the server has said it. */
  instruments = $state.raw<InstrumentList | null>(null);
  volume = $state(remembered().volume);
  muted = $state(remembered().muted);
  hasPlayed = $state(remembered().hasPlayed);
  /** By how much sound comes late on the device that is listened to. */
  readonly latency = new OutputLatency((seconds) => this.view?.setSoundTrim(seconds));

  #listed = $state.raw<readonly ShowParameter[]>([]);
  /** A recording that waits for its score. */
  #kept: File | null = null;
  #opening = 0;
  /** What goes on, the latest last. */
  #doing: readonly { readonly what: string }[] = [];
  #making = 0;
  /** What went wrong last. */
  #failure: unknown = null;
  /** Gives up the upload of what is made, when something else is made in its place. */
  #made = new AbortController();
  readonly #unsent = new UnsentChanges(this.notices);

  constructor(api = new ReinaApi()) {
    this.api = api;
    api.whenBusy = (problem, signal) => this.patience.wait(problem, signal);
    this.signIn = new SignInDesk(api);
    api.askSignIn = () => this.signIn.ask();
  }

  /** Open what the address says; `/` opens this browser's own session of the bundled piece. */
  async start(): Promise<void> {
    void this.#readLists();
    this.#takeControl();
    addEventListener("storage", () => this.#followToken());
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
      // Whoever frames the page could lead a click to any of its buttons.
      const token = isFramed() ? null : (remembered().tokens[id] ?? null);
      const view = await SessionView.open(id, token, {
        api: this.api,
        practice: this.practice,
        tell: (error) => this.tell(error),
        unsent: (error, again) => this.unsent(error, again),
        uploads: this.uploads,
        answered: () => this.notices.answered(),
        gone: () => this.#lose("ended"),
      });
      if (opening !== this.#opening) {
        void view.close();
        return false;
      }
      this.#enter(view);
      return true;
    } catch (error) {
      if (opening !== this.#opening) return false;
      this.#miss(error);
      return false;
    }
  }

  /** Make a session of a bundled piece and go to it; returns whether it is open. */
  openExample(example: Example): Promise<boolean> {
    return this.#make(told.opening({ title: example.title }), async () => {
      const score = await this.api.file(example.score);
      const song = example.song === null ? {} : { song: await this.api.file(example.song) };
      const show = example.show === null ? {} : { show: await this.api.file(example.show) };
      return { score, ...song, ...show };
    });
  }

  /** Make of dropped or chosen files what can be made of them: a new session, a song or a show for the open one. */
  async openFiles(files: readonly File[]): Promise<void> {
    await this.attempt(told.lookingAt({ names: namesOf(files) }), async () => {
      const { scores, songs, shows, unusable } = await sortFiles(files, (file) => this.api.fileRole(file));
      const [score, song, show] = [scores[0], songs[0], shows[0]];
      const aside = [...scores.slice(1), ...songs.slice(1), ...shows.slice(1)];
      if (score !== undefined) await this.#openScore(score, song, show, aside);
      else if (song !== undefined) await this.#askAboutSong(song);
      else if (show !== undefined) await this.putShow(show);
      const [first] = unusable;
      // What went wrong with the score, or is asked of it, goes before.
      if (first !== undefined && (score === undefined || !this.notices.waits)) {
        const lines = unusable.slice(1).map(({ file, told: role }) => `${file.name}: ${role.name}`);
        const title = told.cannotUse({ name: first.file.name, what: first.told.name });
        this.problem(title, first.told.advice, { lines });
      }
    });
  }

  /** Open a score, with a recording that waited for it, and offer the scores that came with it. */
  async #openScore(
    score: File,
    song = this.#kept ?? undefined,
    show?: File,
    aside: readonly File[] = [],
  ): Promise<void> {
    this.#kept = null;
    const files = {
      score,
      ...(song === undefined ? {} : { song }),
      ...(show === undefined ? {} : { show }),
    };
    const made = await this.#make(told.reading({ name: score.name }), () => files, namesOf(Object.values(files)));
    const { view } = this;
    if (!made || view === null) return;
    if (aside.length === 0) {
      this.arrived?.(view);
      return;
    }
    this.notices.say(
      "question",
      told.thisIs({ name: score.name }),
      `${arrivalOf(view.session).title}. ${told.cameWithIt({ names: namesOf(aside) })}`,
      {
        actions: aside.slice(0, OFFERED).map((file) => ({
          label: told.open({ name: file.name }),
          run: () => this.openFiles([file]),
        })),
        over: () => this.view !== view,
      },
    );
  }

  /** Nobody can tell by an audio file what it is a recording of: the person can. */
  async #askAboutSong(song: File): Promise<void> {
    const length = await audioLength(song);
    const { view } = this;
    const keep = {
      label: told.keep,
      run: () => {
        this.#kept = song;
        this.word(told.kept({ name: song.name }), told.keptMeans);
      },
    };
    const find = { label: transcribing.find, run: () => this.findNotes(song) };
    if (view === null) {
      this.notices.say("question", told.whatRecording({ name: song.name }), transcribing.alone, {
        actions: [find, keep],
        over: () => this.view !== null,
      });
      return;
    }
    const { title } = view.session;
    const unlike = length !== null && Math.abs(length - view.duration) > Math.max(ALIKE_SHARE * view.duration, ALIKE_S);
    const piece = { title, length: clockTime(view.duration) };
    const compared = unlike ? told.unlikeLengths : told.lengths;
    this.notices.say(
      "question",
      told.whatRecording({ name: song.name }),
      length === null ? told.pieceIsOpen(piece) : compared({ ...piece, song: clockTime(length) }),
      {
        actions: [{ label: told.playWith({ title }), run: () => this.addSong(song) }, find, keep],
        over: () => this.view !== view,
      },
    );
  }

  /** A new session of a recording of one line and of the notes that are heard in it. */
  async findNotes(song: File): Promise<void> {
    const found = await transcribed(this.api, this.notices, this.uploads, song);
    if (found === null) return;
    const { score, notes, hasBeat } = found;
    const files = { score, song, inTime: true };
    if (!(await this.#make(told.reading({ name: score.name }), () => files, song.name))) return;
    const means = hasBeat ? transcribing.correct : `${transcribing.noBeat} ${transcribing.correct}`;
    this.word(transcribing.found({ count: notes, name: song.name }), means);
  }

  /** A new session of the open one's score, cast and show, with a recording; the server keeps it. */
  async addSong(song: File): Promise<void> {
    const { view } = this;
    if (view === null) return;
    const files = async (): Promise<SessionFiles> => {
      const [score, cast, document] = await Promise.all([
        this.api.scoreFile(view.id),
        this.api.cast(view.id),
        this.#showDocument(view.id),
      ]);
      const show = new File([JSON.stringify(document)], "show.json");
      return { score, song, show, cast, title: view.session.title };
    };
    await this.#make(told.adding({ name: song.name }), files, song.name);
  }

  /** Replace the open session's show. */
  async putShow(file: File): Promise<void> {
    const { id, token = null } = this.view ?? {};
    if (id === undefined || token === null) {
      this.problem(told.notYours, told.notYoursMeans);
      return;
    }
    await this.attempt(told.reading({ name: file.name }), async () => {
      const json: unknown = JSON.parse(await file.text());
      const path = this.api.sessionPath(id, "show");
      await this.uploads.run(file.name, (sending) => this.api.request("PUT", path, { ...sending, json, token }));
      this.word(told.showIsOn({ name: file.name }));
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
    const doing = { what: busy };
    this.notices.clear();
    this.#goOn([...this.#doing, doing]);
    try {
      await action();
      return true;
    } catch (error) {
      this.#failure = error;
      this.tell(error);
      return false;
    } finally {
      this.#goOn(this.#doing.filter((each) => each !== doing));
    }
  }

  #goOn(doing: readonly { readonly what: string }[]): void {
    this.#doing = doing;
    this.busy = doing.at(-1)?.what ?? null;
  }

  /** Show that a change of the open session did not get to the server; `again` makes it once more. */
  unsent(error: unknown, again: () => unknown): void {
    const { view } = this;
    this.#unsent.tell(error, again, () => this.view !== view);
  }

  /** Show what went wrong in the words that came with it. */
  tell(error: unknown): void {
    this.notices.tell(error);
  }

  problem(title: string, detail: string, options?: NoticeOptions): void {
    this.notices.say("problem", title, detail, options);
  }

  /** Say something in passing. */
  word(title: string, detail = "", options?: NoticeOptions): void {
    this.notices.say("word", title, detail, options);
  }

  async #readLists(): Promise<void> {
    const [parameters, examples, instruments] = await Promise.allSettled([
      this.api.parameters(),
      this.api.examples(),
      this.api.instruments(),
    ]);
    if (instruments.status === "fulfilled") this.instruments = instruments.value;
    if (parameters.status === "fulfilled") this.#listed = parameters.value;
    if (examples.status === "fulfilled") this.examples = examples.value;
  }

  async #openHome(): Promise<void> {
    const { home } = remembered();
    if (home !== null && (await this.open(home))) {
      history.replaceState(null, "", addressOf(home));
      return;
    }
    this.phase = "opening";
    this.notices.clear();
    let first: Example | undefined;
    try {
      first = (await this.api.examples())[0];
    } catch (error) {
      this.#miss(error);
      return;
    }
    if (first === undefined) this.#lose("failed");
    else {
      const opened = await this.openExample(first);
      if (opened && this.view !== null) remember({ home: this.view.id });
    }
  }

  /**
   * Make a session and open it; returns whether that went well, and nothing else was asked for meanwhile.
   *
   * @param own the names of one's own files, whose upload is shown
   */
  async #make(busy: string, files: () => SessionFiles | Promise<SessionFiles>, own?: string): Promise<boolean> {
    this.#made.abort();
    this.#made = new AbortController();
    const { signal } = this.#made;
    const wasHome = SESSION_PATH.exec(location.pathname) === null;
    const making = ++this.#making;
    const takeBack = ({ id, control_token }: CreatedSession): Promise<void> =>
      this.api.deleteSession(id, control_token).catch(() => undefined);
    const made = await this.attempt(busy, async () => {
      const given = await files();
      const made = await (own === undefined
        ? this.api.createSession(given, { again: true })
        : this.uploads.run(own, (sending) => this.api.createSession(given, sending), { takeBack, signal }));
      // What was dropped since takes the place of what is not open yet.
      if (making !== this.#making) {
        await takeBack(made);
        return;
      }
      rememberToken(made.id, made.control_token);
      if (wasHome) history.replaceState(null, "", addressOf(made.id));
      else history.pushState(null, "", addressOf(made.id));
      if (!(await this.open(made.id))) return;
      // A short recording is searched by the time the page has looked.
      if (made.alignment.status === "searching" && this.view?.alignment.status !== "searching") {
        if (this.view !== null) this.view.searchEnded = true;
      }
    });
    if (making !== this.#making) return false;
    if (this.view === null && this.phase === "opening") {
      // Given up before there was a first piece.
      if (own !== undefined && this.#failure instanceof GivenUpError) await this.#openHome();
      else this.#miss(this.#failure);
    }
    return made;
  }

  async #showDocument(id: string): Promise<unknown> {
    return (await this.api.request("GET", this.api.sessionPath(id, "show"))).json();
  }

  /** Make the open session's control link anew: those that were given away control nothing any more. */
  async renewControl(view: SessionView): Promise<void> {
    if (view.token === null) return;
    rememberToken(view.id, await this.api.renewToken(view.id, view.token));
    if (this.view === view) await this.open(view.id);
  }

  /** Go on with the token that another tab of this browser has made anew. */
  #followToken(): void {
    const { view } = this;
    if (typeof view?.token !== "string") return;
    const kept = remembered().tokens[view.id];
    if (kept !== undefined && kept !== view.token) void this.open(view.id);
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
    view.setSoundTrim(this.latency.seconds);
    view.setClickVolume(this.practice.clickVolume);
    document.title = `${view.session.title} · Reina`;
    const { pieces } = remembered();
    if (view.canControl) {
      remember({ pieces: { ...pieces, [view.id]: { title: view.session.title, opened: Date.now() } } });
    }
  }

  /** No session could be opened; what the page says in its place is not told beside it. */
  #miss(error: unknown): void {
    const absence = absenceOf(error);
    this.#lose(absence);
    this.notices.clear();
    if (absence === "failed" && !(error instanceof ProblemError && error.isUnanswered)) this.tell(error);
  }

  #lose(phase: Absence): void {
    removePoster();
    void this.view?.close();
    this.view = null;
    this.phase = phase;
    document.title = "Reina";
  }
}

/** Why there is no session where an error kept it from being opened. */
function absenceOf(error: unknown): Absence {
  if (!(error instanceof ProblemError)) return "failed";
  if (error.isUnknown) return "unknown";
  if (error.needsSignIn) return "guest";
  return error.isBusy || error instanceof GivenUpError ? "busy" : "failed";
}

/** A session's address in the browser; what the address asks for beside it (`?tier=`) stays. */
function addressOf(id: string): string {
  return `/s/${encodeURIComponent(id)}${location.search}`;
}
