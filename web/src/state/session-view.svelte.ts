import {
  BlockFeed,
  type ClockSync,
  type PlayedFrame,
  ProblemError,
  QuietProbes,
  countInAt,
  songTimeAt,
  Stream,
  streamAddress,
  type ReinaApi,
  type StreamState,
} from "../connection";
import type {
  AlignmentState,
  Cast,
  Hello,
  Score,
  ServerMessage,
  Session,
  SessionChange,
  ShowChanged,
  TransportCommand,
  TransportState,
  WireNote,
} from "../generated/protocol";
import { Metronome, monoWav, sameMotion, SongPlayer, soundTone, type SoundState } from "../sound";
import { isListenedTo } from "./alignment-words";
import { CastState } from "./cast.svelte";
import { isFramed } from "./framed";
import { lineNotes } from "./line-notes";
import { Refresh } from "./refresh";
import { heldAt, stepFrom } from "./note-steps";
import type { PracticeChoices } from "./practice-choices.svelte";
import { PartSound } from "./part-sound.svelte";
import { SongLoading } from "./song-loading.svelte";
import { SyncMeasure } from "./sync-measure";
import { TransportQueue } from "./transport-queue";
import type { Uploads } from "./uploads.svelte";
import { watchWakes } from "./wakes";
import { told } from "../words/told/en";

const CHECK_INTERVAL_MS = 100;
/** A block of some kilobytes that has not come by then does not come. */
const BLOCK_MS = 3000;
/** The last frame of a song stands up to this much before its end. */
const END_TOLERANCE_S = 0.025;

/** What a session view needs of the page around it. */
export interface Surroundings {
  readonly api: ReinaApi;
  /** How the page practises. */
  readonly practice: PracticeChoices;
  /** Show what went wrong. */
  tell(error: unknown): void;
  /** Show that a change did not get to the server; `again` makes it once more. */
  unsent(error: unknown, again: () => unknown): void;
  /** Send something large, so that the person sees how far it is and can give it up. */
  readonly uploads: Uploads;
  /** The server has answered. */
  answered(): void;
  /** The session is gone from the server. */
  gone(): void;
}

/** One session as this page sees it: what it is, its clock, its frames and its sound. */
export class SessionView {
  readonly id: string;
  /** What changes the session; empty where its owner is signed in, null where this page may only watch. */
  readonly token: string | null;
  readonly sync = new SyncMeasure();
  /** Who plays what, and whom the strips follow here. */
  readonly cast: CastState;
  /** How the part and everything are heard here. */
  readonly partSound: PartSound;

  session: Session;
  score: Score;
  hello = $state.raw<Hello | null>(null);
  transport: TransportState;
  connection = $state<StreamState>("connecting");
  /** Song time of the picture, seconds. */
  songTime = $state(0);
  sound = $state<SoundState>("silent");
  /** Whether the song keeps its pitch where it is slower or faster; some browsers and addresses do not let it. */
  keepsPitch = $state(true);
  /** Play was asked for, and waits for the sound of this place. */
  starting = $state(false);
  /** How far the score is in time with the recording. */
  alignment: AlignmentState;
  /** What this page decoded of the recording is on its way to the server, which does not decode it. */
  sending = $state(false);
  /** A search for the score in the recording has come to its end, and nobody was told yet. */
  searchEnded = $state(false);
  /** The last change of the show that the server told of. */
  showTold = $state.raw<ShowChanged | null>(null);

  /** How long the music lasts, seconds. */
  duration = $state(0);
  /** Whether the music runs; at its end it has stopped by itself. */
  readonly playing = $derived.by(
    () => this.transport.playing && (this.transport.loop !== null || this.songTime < this.duration - END_TOLERANCE_S),
  );
  /** The notes of the parts that the followed player plays, by onset. */
  readonly playedNotes: readonly WireNote[] = $derived.by(() => {
    const { followed } = this.cast;
    return this.score.notes.filter((note) => note.player === followed);
  });

  /** Of these the ones that sound, one at a time. */
  readonly line: readonly WireNote[] = $derived.by(() => lineNotes(this.playedNotes));

  readonly #surroundings: Surroundings;
  readonly #commands = new TransportQueue((command) => this.#request(command));
  #changes: Promise<void> = Promise.resolve();
  readonly #stream: Stream;
  readonly #player: SongPlayer;
  readonly #song: SongLoading;
  readonly #metronome: Metronome;
  /** The page's sound is on. */
  #audible = true;
  #endTone: () => void = () => undefined;
  readonly #checking: ReturnType<typeof setInterval>;
  readonly #unwatch: () => void;
  readonly #probes: QuietProbes;
  readonly #refresh = new Refresh();
  /** The picture that was drawn last, until it is seen: its song time, epoch and when it was drawn. */
  #coming = { songTime: 0, epoch: -1, drawnAt: 0 };
  readonly #ended = new AbortController();
  #feed: BlockFeed | null = null;
  /** The transport says of every moment what it said on a clock that was known. */
  #goesOn = false;
  #followed: TransportState | null = null;
  #readings = 0;
  /** The clock's epoch when the score was read, until the stream has greeted; null where it was lost since. */
  #readAt: number | null;
  /** The stream has greeted, and tells of every change from there on. */
  #greeted = false;

  /** Get a session's score and clock and join its stream. Throws ProblemError when there is none. */
  static async open(id: string, token: string | null, surroundings: Surroundings): Promise<SessionView> {
    const { api } = surroundings;
    const [transport, session, score, cast] = await Promise.all([
      // First: by its epoch the stream's greeting tells whether anything of the rest is another since.
      api.transport(id),
      api.session(id),
      api.score(id),
      api.cast(id),
    ]);
    const control = token ?? (session.mine && !isFramed() ? "" : null);
    return new SessionView(session, score, cast, transport, control, surroundings);
  }

  private constructor(
    session: Session,
    score: Score,
    cast: Cast,
    transport: TransportState,
    token: string | null,
    surroundings: Surroundings,
  ) {
    this.id = session.id;
    this.token = token;
    this.session = $state.raw(session);
    this.score = $state.raw(score);
    this.cast = new CastState(
      cast,
      (fields) => surroundings.api.changeCast(session.id, fields, token ?? ""),
      (error, again) => this.#failToChange(error, again),
    );
    this.partSound = new PartSound(session.id);
    this.transport = $state.raw(transport);
    this.alignment = $state.raw(session.alignment);
    this.duration = session.duration_s;
    this.songTime = transport.song_time_s;
    this.#readAt = transport.epoch;
    this.#surroundings = surroundings;
    this.#player = new SongPlayer(
      {
        pageNow: () => performance.now() / 1000,
        songTimeAt: (pageTime) => this.#songTimeAt(pageTime),
        pictured: () => this.#pictured,
        countInAt: (pageTime) => countInAt(this.transport, this.#stream.clock.serverTime(pageTime)),
      },
      (state) => {
        this.sound = state;
        this.#startWithSound();
      },
    );
    this.#song = new SongLoading(
      {
        api: surroundings.api,
        session: this.id,
        player: this.#player,
        isRecording: () => this.isRecording,
        decoded: (whole) => void this.#sendDecoded(whole),
        silent: () => this.#startWithSound(),
        fail: (error) => this.#fail(error),
      },
      this.partSound,
      () => this.cast.followed,
    );
    this.#metronome = new Metronome(() => this.#player.context, {
      pathNow: () => this.#player.pathNow(),
      clicksIn: (piece) => {
        const { rate, loop, count_in_s } = this.transport;
        const counted = piece.shift > 0 ? (loop?.count_in_s ?? 0) : count_in_s;
        return surroundings.practice.clicksIn(this.score, piece, { counted, rate, heard: this.#audible });
      },
    });
    this.#stream = new Stream(streamAddress(session.links.stream), {
      message: (message) => this.#receive(message),
      block: (bytes) => void this.#feed?.take(bytes),
      connection: (state) => this.#connected(state),
    });
    this.#probes = new QuietProbes(this.#stream.clock, (number) => surroundings.api.clockProbe(number));
    this.#probes.begin();
    this.#checking = setInterval(() => this.#check(), CHECK_INTERVAL_MS);
    this.#unwatch = watchWakes((asleep) => this.wake(asleep));
  }

  get api(): ReinaApi {
    return this.#surroundings.api;
  }

  get canControl(): boolean {
    return this.token !== null;
  }

  /**
   * The picture to be drawn in a turn of the display; null until the first frame has come.
   *
   * @param turn the turn's time as requestAnimationFrame gives it, seconds
   */
  frameAt(turn: number): PlayedFrame | null {
    this.#measureSync(turn);
    const seenAt = this.#refresh.seenAt(turn, performance.now() / 1000);
    if (!this.#timeKnown) return null;
    const serverTime = this.#stream.clock.serverTime(seenAt);
    const frame = this.#feed?.frameAt(this.transport, serverTime, this.duration) ?? null;
    if (frame === null) return null;
    if (frame.songTime !== this.songTime) this.songTime = frame.songTime;
    const runs = frame.playing && frame.epoch === this.transport.epoch;
    this.#coming = { songTime: frame.songTime, epoch: runs ? frame.epoch : -1, drawnAt: turn };
    return frame;
  }

  /** What was drawn in the turn before is seen now: compare it with what is heard. */
  #measureSync(turn: number): void {
    const { songTime, epoch, drawnAt } = this.#coming;
    if (epoch !== this.transport.epoch) return;
    const ahead = this.#player.heardAhead(songTime, turn);
    if (ahead !== null) this.sync.add(-ahead / this.transport.rate, turn - drawnAt);
  }

  /**
   * The page may have missed something: see that clock, connection and sound are as they should be.
   *
   * @param asleep for how long nothing of it ran, seconds; 0 where that is not known
   */
  wake(asleep: number): void {
    this.#stream.wake(asleep);
    this.#probes.begin();
    this.#player.wake();
  }

  /** How far the sound is ahead of the server's song time, seconds; null while none is heard. */
  get soundAhead(): number | null {
    return this.#player.soundAhead();
  }

  /** The song time that is heard, seconds; null while none is. */
  get heard(): number | null {
    return this.#player.heardSongTime();
  }

  /** For how long the picture goes on with what is here, seconds, up to 2.5. */
  get ahead(): number {
    return this.#feed?.ahead(this.transport, this.#stream.serverNow(), this.duration) ?? 0;
  }

  /** The picture that was drawn last; null before the first. Read, never kept. */
  get drawn(): Readonly<PlayedFrame> | null {
    return this.#feed?.drawn ?? null;
  }

  /** The server's clock as it is known here. */
  get clock(): Pick<ClockSync, "serverTime" | "roundTrip" | "ready"> {
    return this.#stream.clock;
  }

  /** The share of the song's making that is done, while it is being made; null once it is there. */
  get soundShare(): number | null {
    return this.#song.share;
  }

  /** Why there is no sound; null where there is some, or will be. */
  get soundError(): string | null {
    return this.#song.error;
  }

  /** How loud what leaves the page is at this moment, 0…1. */
  get soundLevel(): number {
    return this.#player.level;
  }

  /** How many seconds of sound are decoded. */
  get soundHeld(): number {
    return this.#player.held;
  }

  /** Song time that a step goes on from, seconds: where the clock stands, or will once it has done what was asked. */
  get here(): number {
    return this.#commands.asked.songTime ?? this.#songTimeAt(performance.now() / 1000);
  }

  /** Whether the clock has been asked for something that is not answered yet. */
  get asking(): boolean {
    return this.#commands.waits;
  }

  /** The rate that it plays at, or will. */
  get rate(): number {
    return this.#commands.asked.rate ?? this.transport.rate;
  }

  /** Play, as soon as the sound of this place is there. */
  async play(): Promise<void> {
    void this.unlockSound();
    if (this.#soundComes) this.starting = this.canControl;
    else await this.#control(this.#playCommand());
  }

  async pause(): Promise<void> {
    this.starting = false;
    await this.#control({ action: "pause" });
  }

  async toggle(): Promise<void> {
    // Also where it pauses: the browser asks for a click or a key, whatever that is for.
    void this.unlockSound();
    if (this.starting) this.starting = false;
    else await ((this.#commands.asked.playing ?? this.playing) ? this.pause() : this.play());
  }

  async seek(songTime: number): Promise<void> {
    const within = Math.min(Math.max(songTime, 0), this.duration);
    await this.#control({ action: "seek", song_time_s: within });
  }

  async setRate(rate: number): Promise<void> {
    await this.#control({ action: "rate", rate });
  }

  /** Loop over a span of song time, seconds; null ends the loop. */
  async setLoop(loop: { start: number; end: number } | null): Promise<void> {
    const count_in_s = loop === null ? 0 : this.#surroundings.practice.countInOfRounds(this.score, loop.start);
    await this.#control({ action: "loop", start_s: loop?.start ?? null, end_s: loop?.end ?? null, count_in_s });
  }

  /** Stop at the followed player's next note (1) or the one before (-1), held; null where there is none. */
  step(direction: 1 | -1): WireNote | null {
    const note = stepFrom(this.line, this.here, direction, this.fps);
    if (note !== null) this.hold(note);
    return note;
  }

  /** Stop at a note, where its fingering is held. */
  hold(note: WireNote): void {
    if (this.starting || (this.#commands.asked.playing ?? this.playing)) void this.pause();
    void this.seek(heldAt(note, this.fps));
  }

  /** Frames a second of song time. */
  get fps(): number {
    return this.hello?.fps ?? 60;
  }

  /** Let a pitch be heard as a plain tone, as loud as the metronome; the one before ends. */
  soundNote(pitch: number): void {
    void this.unlockSound();
    this.#endTone();
    this.#endTone = soundTone(this.#player.context, this.#metronome.out, pitch);
  }

  /** Change the session, after the changes that are still on their way. */
  change(change: SessionChange): Promise<void> {
    const { token } = this;
    if (token === null) return Promise.resolve();
    this.#changes = this.#changes.then(async () => {
      try {
        this.session = await this.#surroundings.api.changeSession(this.id, change, token);
        this.#surroundings.answered();
      } catch (error) {
        this.#failToChange(error, () => this.change(change));
      }
    });
    return this.#changes;
  }

  /** Read what the server says of the session: its warnings change with the show. */
  async readSession(): Promise<void> {
    await this.#attempt(async () => {
      this.session = await this.#surroundings.api.session(this.id);
    });
  }

  /** Take what the server says of how far score and recording are in time. */
  followAlignment(alignment: AlignmentState): void {
    if (this.alignment.status === "searching" && alignment.status !== "searching") this.searchEnded = true;
    this.alignment = alignment;
  }

  /** Whether the song is a recording, and was not made from the score. */
  get isRecording(): boolean {
    return (this.hello?.song.source ?? this.session.song.source) === "uploaded";
  }

  /** Let a moment of the song be heard where nothing plays: for a pointer on a timeline. */
  scrub(songTime: number): void {
    this.#player.scrub(songTime);
  }

  /** Let the sound out; call it from a click or a key. */
  unlockSound(): Promise<void> {
    return this.#player.unlock();
  }

  /** Seconds by which sound comes to the ear later than the browser knows. */
  setSoundTrim(trim: number): void {
    this.#player.setTrim(trim);
  }

  /** Let a click be heard at a time of the page's clock, seconds. */
  click(pageTime: number): void {
    this.#player.click(pageTime);
  }

  /** Hear the part or everything otherwise; nobody else does. */
  hear(change: { balance?: number; semitones?: number }): void {
    this.partSound.choose(change);
    this.#song.hear();
  }

  setVolume(volume: number, muted: boolean): void {
    this.#player.setVolume(volume, muted);
    this.#audible = volume > 0 && !muted;
  }

  /** Of the metronome and of tones, 0…1. */
  setClickVolume(volume: number): void {
    this.#metronome.setVolume(volume);
  }

  async close(): Promise<void> {
    clearInterval(this.#checking);
    this.#unwatch();
    this.#probes.close();
    this.#ended.abort();
    this.#song.close();
    this.#feed?.close();
    this.#stream.close();
    await this.#player.close();
  }

  async #control(command: TransportCommand): Promise<void> {
    if (this.token !== null) await this.#commands.add(command);
  }

  async #request(command: TransportCommand): Promise<TransportState | null> {
    const { token } = this;
    if (token === null) return null;
    try {
      const state = await this.#surroundings.api.control(this.id, command, token);
      this.#surroundings.answered();
      this.#setTransport(state);
      return state;
    } catch (error) {
      this.#fail(error);
      return null;
    }
  }

  async #attempt(action: () => Promise<void>): Promise<void> {
    try {
      await action();
      this.#surroundings.answered();
    } catch (error) {
      this.#fail(error);
    }
  }

  #fail(error: unknown): void {
    if (!this.#ended.signal.aborted) this.#surroundings.tell(error);
  }

  #failToChange(error: unknown, again: () => unknown): void {
    if (!this.#ended.signal.aborted) this.#surroundings.unsent(error, again);
  }

  #receive(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        this.#feedFrom(message);
        this.hello = message;
        this.duration = message.duration_s;
        this.#takeGreeting(message.transport.epoch);
        this.#setTransport(message.transport, true);
        this.followAlignment(message.alignment);
        this.#song.load(message.song);
        break;
      case "transport":
        this.#setTransport(message);
        break;
      case "blocks_changed":
        this.#feed?.follow(message);
        break;
      case "score_changed":
        this.duration = message.duration_s;
        void this.#attempt(() => this.#readAnew());
        this.#song.load(message.song);
        break;
      case "show_changed":
        this.showTold = message;
        break;
      case "alignment_changed":
        this.followAlignment(message);
        break;
      case "song_ready":
        this.#song.ready(message.song);
        break;
      case "error":
        this.#surroundings.tell(
          new ProblemError({ status: 0, title: message.title, detail: message.detail, errors: [] }),
        );
        break;
      default:
        break;
    }
  }

  /** Go on with the blocks that are here, where those of a `hello` are laid out like them. */
  #feedFrom(hello: Hello): void {
    if (this.#feed?.fits(hello) === true) {
      this.#feed.follow(hello.blocks);
      return;
    }
    this.#feed?.close();
    const feed = new BlockFeed(hello, {
      now: () => performance.now() / 1000,
      get: (href, signal) => this.#getBlock(href, signal),
      came: () => {
        if (this.transport.playing && this.#pictured) this.#player.pictureCame();
      },
      unlike: (fault) => {
        if (this.#feed === feed) this.#refuseFeed(fault);
      },
    });
    this.#feed = feed;
  }

  async #getBlock(href: string, signal: AbortSignal): Promise<ArrayBuffer> {
    const either = AbortSignal.any([signal, AbortSignal.timeout(BLOCK_MS)]);
    const response = await this.#surroundings.api.request("GET", href, { signal: either, again: false });
    return await response.arrayBuffer();
  }

  /** Blocks that do not fit what `hello` said are dropped; saying so once is enough. */
  #refuseFeed(fault: RangeError): void {
    this.#surroundings.tell(
      new ProblemError({
        status: 0,
        title: told.unlikeServer,
        detail: told.reload({ fault: fault.message }),
        errors: [],
      }),
    );
    this.#feed?.close();
    this.#feed = null;
  }

  #setTransport(transport: TransportState, anew = false): void {
    if (!anew && transport.epoch < this.transport.epoch) return;
    // A clock that is another would have other motion: another server's does not go on where the one before was.
    if (anew) this.#goesOn &&= sameMotion(this.transport, transport);
    this.transport = transport;
    this.#feed?.expect();
    this.#check();
  }

  #connected(state: StreamState): void {
    this.connection = state;
    if (state === "open") this.#surroundings.answered();
    if (state === "lost") {
      this.#goesOn = this.#timeKnown;
      this.#greeted = false;
      this.#readAt = null;
      void this.#lookWhetherGone();
    }
  }

  /** Read what changed before the stream told of changes: another cast, or a recording in which the score was found. */
  #takeGreeting(epoch: number): void {
    if (!this.#greeted && epoch !== this.#readAt) void this.#attempt(() => this.#readAnew());
    this.#greeted = true;
  }

  async #lookWhetherGone(): Promise<void> {
    try {
      this.session = await this.#surroundings.api.session(this.id, { again: false });
    } catch (error) {
      if (error instanceof ProblemError && error.isUnknown && !this.#ended.signal.aborted) this.#surroundings.gone();
    }
  }

  async #readAnew(): Promise<void> {
    const { api } = this.#surroundings;
    const reading = ++this.#readings;
    const { answers } = this.cast;
    const [session, score, cast] = await Promise.all([api.session(this.id), api.score(this.id), api.cast(this.id)]);
    // What was overtaken by another change is out of date.
    if (reading !== this.#readings) return;
    this.session = session;
    this.score = score;
    // The answer to a change is newer, and the stream tells of that change too.
    if (this.cast.answers === answers) this.cast.take(cast);
  }

  /** Follow the transport once the server's clock is known, and keep the sound in its place. */
  #check(): void {
    if (this.#timeKnown) {
      const roundTrip = this.connection === "open" ? this.#stream.clock.roundTrip : null;
      this.#feed?.look(this.transport, this.#stream.serverNow(), this.duration, roundTrip);
    }
    if (!this.#stream.clock.ready) return;
    if (this.#followed !== this.transport) {
      this.#followed = this.transport;
      this.#player.follow(this.transport);
    }
    this.#song.hear();
    this.#player.check();
    const { metronome, division } = this.#surroundings.practice;
    this.#metronome.check(`${this.transport.epoch} ${this.#player.motions} ${metronome} ${division} ${this.#audible}`);
    this.keepsPitch = this.#player.keepsPitch;
  }

  /** Play, counted in as the page does. */
  #playCommand(): TransportCommand {
    const { practice } = this.#surroundings;
    const place = this.here < this.duration - END_TOLERANCE_S ? this.here : 0;
    return { action: "play", count_in_s: practice.countInTo(this.score, place, this.rate) };
  }

  #songTimeAt(pageTime: number): number {
    return songTimeAt(this.transport, this.#stream.clock.serverTime(pageTime), this.duration);
  }

  /**
   * Whether it is known what is to be drawn now. Behind a new connection there may be another server, whose clock
   * counts from another beginning: until it has answered, only what stands or goes on as before is.
   */
  get #timeKnown(): boolean {
    return this.#stream.clock.ready || !this.transport.playing || this.#goesOn;
  }

  /** Whether the picture of this moment is here. */
  get #pictured(): boolean {
    return this.#feed?.isPictured(this.transport, this.#stream.serverNow(), this.duration) ?? false;
  }

  get #soundComes(): boolean {
    return this.soundError === null && (this.sound === "silent" || this.sound === "coming");
  }

  /** Begin what waited for sound, once it is there or there will be none. */
  #startWithSound(): void {
    if (!this.starting || this.#soundComes) return;
    this.starting = false;
    void this.#control(this.#playCommand());
  }

  /** Send a recording that the server does not decode, decoded, to have the score looked for in it. */
  async #sendDecoded(whole: AudioBuffer): Promise<void> {
    const { api, id, token } = this;
    if (token === null || !this.isRecording || isListenedTo(this)) return;
    this.sending = true;
    await this.#attempt(async () => {
      const body = await monoWav(whole);
      const { title } = this.session;
      const path = api.sessionPath(id, "song/analysis");
      // How the search goes, the stream tells.
      await this.#surroundings.uploads.run(title, (sending) => api.request("PUT", path, { ...sending, body, token }), {
        signal: this.#ended.signal,
      });
    });
    this.sending = false;
  }
}
