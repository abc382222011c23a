import {
  FrameQueue,
  ProblemError,
  songTimeAt,
  Stream,
  streamAddress,
  type QueuedFrame,
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
  SongState,
  TransportCommand,
  TransportState,
  WireNote,
} from "../generated/protocol";
import {
  AS_WRITTEN,
  besideEachOther,
  isAsWritten,
  loadSegment,
  loadWhole,
  plannedSong,
  queriesOf,
  SegmentedSong,
  SongPlayer,
  songState,
  WholeSong,
  type Hearing,
  type SoundState,
} from "../sound";
import { CastState } from "./cast.svelte";
import { lineNotes } from "./line-notes";
import { PartSound } from "./part-sound.svelte";
import { SyncMeasure } from "./sync-measure";
import { TransportQueue } from "./transport-queue";
import { told } from "../words/told/en";

const CHECK_INTERVAL_MS = 100;
const SHARE_INTERVAL_MS = 1000;
/** A picture drawn now is seen at the display's next refresh. */
const PRESENTATION_S = 1 / 60;
/** The last frame of a song stands up to this much before its end. */
const END_TOLERANCE_S = 0.025;

/** What a session view needs of the page around it. */
export interface Surroundings {
  readonly api: ReinaApi;
  /** Show what went wrong. */
  tell(error: unknown): void;
  /** The server has answered. */
  answered(): void;
  /** The session is gone from the server. */
  gone(): void;
}

/** One session as this page sees it: what it is, its clock, its frames and its sound. */
export class SessionView {
  readonly id: string;
  /** What changes the session; null where this browser did not make it and may only watch. */
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
  /** The share of the song's making that is done, while it is being made; null once it is there. */
  soundShare = $state<number | null>(0);
  soundError = $state<string | null>(null);
  /** Whether the song keeps its pitch where it is slower or faster; some browsers and addresses do not let it. */
  keepsPitch = $state(true);
  /** Play was asked for, and waits for the sound of this place. */
  starting = $state(false);
  /** How far the score is in time with the recording. */
  alignment: AlignmentState;
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
  readonly #checking: ReturnType<typeof setInterval>;
  readonly #ended = new AbortController();
  #queue: FrameQueue | null = null;
  #followed: TransportState | null = null;
  #songHref: string | null = null;
  #song: SongState | null = null;
  #heard = "";
  #songWanted = new AbortController();
  #readings = 0;

  /** Get a session's score and clock and join its stream. Throws ProblemError when there is none. */
  static async open(id: string, token: string | null, surroundings: Surroundings): Promise<SessionView> {
    const { api } = surroundings;
    const [session, score, cast, transport] = await Promise.all([
      api.session(id),
      api.score(id),
      api.cast(id),
      api.transport(id),
    ]);
    return new SessionView(session, score, cast, transport, token, surroundings);
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
      (error) => this.#fail(error),
    );
    this.partSound = new PartSound(session.id);
    this.transport = $state.raw(transport);
    this.alignment = $state.raw(session.alignment);
    this.duration = session.duration_s;
    this.songTime = transport.song_time_s;
    this.#surroundings = surroundings;
    this.#player = new SongPlayer(
      { pageNow: () => performance.now() / 1000, songTimeAt: (pageTime) => this.#songTimeAt(pageTime) },
      (state) => {
        this.sound = state;
        this.#startWithSound();
      },
    );
    this.#stream = new Stream(streamAddress(session.links.stream), {
      message: (message) => this.#receive(message),
      frames: (bytes) => this.#takeFrames(bytes),
      connection: (state) => this.#connected(state),
    });
    this.#checking = setInterval(() => this.#check(), CHECK_INTERVAL_MS);
  }

  get api(): ReinaApi {
    return this.#surroundings.api;
  }

  get canControl(): boolean {
    return this.token !== null;
  }

  /** The picture to be drawn now; null until the first frame has come. */
  frameNow(): QueuedFrame | null {
    const frame = this.#queue?.frameAt(this.#stream.serverNow() + PRESENTATION_S) ?? null;
    if (frame === null) return null;
    if (frame.songTime !== this.songTime) this.songTime = frame.songTime;
    const heard = frame.playing ? this.#player.heardSongTime() : null;
    if (heard !== null) this.sync.add(frame.songTime - PRESENTATION_S * this.transport.rate - heard);
    return frame;
  }

  /** How far the sound is ahead of the server's song time, seconds; null while none is heard. */
  get soundAhead(): number | null {
    return this.#player.soundAhead();
  }

  /** The picture that was drawn last; null before the first. Read, never kept. */
  get drawn(): Readonly<QueuedFrame> | null {
    return this.#queue?.drawn ?? null;
  }

  /** Seconds from the page's clock to the server's, and the round trip that this rests on. */
  get clock(): { offset: number; roundTrip: number; ready: boolean } {
    return this.#stream.clock;
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

  /** The rate that it plays at, or will. */
  get rate(): number {
    return this.#commands.asked.rate ?? this.transport.rate;
  }

  /** Play, as soon as the sound of this place is there. */
  async play(): Promise<void> {
    void this.unlockSound();
    if (this.#soundComes) this.starting = this.canControl;
    else await this.#control({ action: "play" });
  }

  async pause(): Promise<void> {
    this.starting = false;
    await this.#control({ action: "pause" });
  }

  async toggle(): Promise<void> {
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
    await this.#control({ action: "loop", start_s: loop?.start ?? null, end_s: loop?.end ?? null });
  }

  /** Change the session, after the changes that are still on their way. */
  change(change: SessionChange): Promise<void> {
    const { token } = this;
    if (token === null) return Promise.resolve();
    this.#changes = this.#changes.then(() =>
      this.#attempt(async () => {
        this.session = await this.#surroundings.api.changeSession(this.id, change, token);
      }),
    );
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

  /** Hear the part or everything otherwise; nobody else does. */
  hear(change: { balance?: number; semitones?: number }): void {
    this.partSound.choose(change);
    this.#hear();
  }

  setVolume(volume: number, muted: boolean): void {
    this.#player.setVolume(volume, muted);
  }

  async close(): Promise<void> {
    clearInterval(this.#checking);
    this.#ended.abort();
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

  #receive(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        this.#queue = new FrameQueue(message, message.transport.epoch);
        this.hello = message;
        this.duration = message.duration_s;
        this.#setTransport(message.transport, true);
        this.followAlignment(message.alignment);
        this.#loadSong(message.song);
        break;
      case "transport":
        this.#setTransport(message);
        break;
      case "score_changed":
        this.duration = message.duration_s;
        void this.#attempt(() => this.#readAnew());
        this.#loadSong(message.song);
        break;
      case "show_changed":
        this.showTold = message;
        break;
      case "alignment_changed":
        this.followAlignment(message);
        break;
      case "song_ready":
        this.soundShare = message.song.segments === null ? this.soundShare : null;
        this.#loadSong(message.song);
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

  /** Frames that do not fit what `hello` said are dropped; saying so once is enough. */
  #takeFrames(bytes: ArrayBuffer): void {
    try {
      this.#queue?.push(bytes);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      this.#surroundings.tell(
        new ProblemError({
          status: 0,
          title: told.unlikeServer,
          detail: told.reload({ fault: error.message }),
          errors: [],
        }),
      );
      this.#queue = null;
    }
  }

  #setTransport(transport: TransportState, anew = false): void {
    if (!anew && transport.epoch < this.transport.epoch) return;
    this.transport = transport;
    this.#queue?.enterEpoch(transport.epoch);
    this.#check();
  }

  #connected(state: StreamState): void {
    this.connection = state;
    if (state === "open") this.#surroundings.answered();
    if (state === "lost") void this.#lookWhetherGone();
  }

  async #lookWhetherGone(): Promise<void> {
    try {
      this.session = await this.#surroundings.api.session(this.id);
    } catch (error) {
      if (error instanceof ProblemError && error.isUnknown && !this.#ended.signal.aborted) this.#surroundings.gone();
    }
  }

  async #readAnew(): Promise<void> {
    const { api } = this.#surroundings;
    const reading = ++this.#readings;
    const [session, score, cast] = await Promise.all([api.session(this.id), api.score(this.id), api.cast(this.id)]);
    // What was overtaken by another change is out of date.
    if (reading !== this.#readings) return;
    this.session = session;
    this.score = score;
    this.cast.take(cast);
  }

  /** Follow the transport once the server's clock is known, and keep the sound in its place. */
  #check(): void {
    if (!this.#stream.clock.ready) return;
    if (this.#followed !== this.transport) {
      this.#followed = this.transport;
      this.#player.follow(this.transport);
    }
    this.#hear();
    this.#player.check();
    this.keepsPitch = this.#player.keepsPitch;
  }

  /** Have what the person wants to hear of the song: another part where another player is followed. */
  #hear(): void {
    this.#player.setBalance(this.partSound.balance);
    if (this.#song !== null && this.#heard !== "" && this.#heard !== this.#queries) this.#loadSong(this.#song);
  }

  get #hearing(): Hearing {
    return this.isRecording ? AS_WRITTEN : this.partSound.hearing(this.cast.followed);
  }

  /** What names it. */
  get #queries(): string {
    return `${queriesOf(this.#hearing).join()}?`;
  }

  #songTimeAt(pageTime: number): number {
    return songTimeAt(this.transport, this.#stream.clock.serverTime(pageTime), this.duration);
  }

  get #soundComes(): boolean {
    return this.soundError === null && (this.sound === "silent" || this.sound === "coming");
  }

  /** Begin what waited for sound, once it is there or there will be none. */
  #startWithSound(): void {
    if (!this.starting || this.#soundComes) return;
    this.starting = false;
    void this.#control({ action: "play" });
  }

  #loadSong(song: SongState): void {
    const isSameMusic = this.#song?.href === song.href && this.#songHref !== null;
    this.#song = song;
    if (this.#songHref === song.href && this.#heard === this.#queries) return;
    this.#songHref = song.href;
    this.#heard = this.#queries;
    this.#songWanted.abort();
    this.#songWanted = new AbortController();
    void this.#takeSong(song, isSameMusic, AbortSignal.any([this.#ended.signal, this.#songWanted.signal]));
  }

  async #takeSong(known: SongState, isSameMusic: boolean, signal: AbortSignal): Promise<void> {
    const hearing = this.#hearing;
    this.soundShare = 0;
    this.soundError = null;
    // What sounded before belongs to other fingers, unless it is only heard otherwise.
    if (!isSameMusic) this.#player.setSong(null);
    try {
      const songs = await this.#planned(known, hearing, signal);
      const [first] = songs;
      if (first?.segments === null) await this.#takeWhole(songs, signal);
      else if (!signal.aborted) {
        this.#player.goOverTo(this.#segmented(songs, signal));
        await this.#followMaking(songs, hearing, signal);
      }
    } catch (error) {
      this.#notHeard(error, hearing, signal);
    }
    if (!signal.aborted) this.soundShare = null;
  }

  /** The songs that a hearing takes, as soon as their segments can be had. */
  #planned(known: SongState, hearing: Hearing, signal: AbortSignal): Promise<SongState[]> {
    const { api } = this.#surroundings;
    return Promise.all(
      queriesOf(hearing).map(async (query) => {
        const song = query === "" ? known : await songState(api, this.id, signal, query);
        return plannedSong(api, this.id, song, signal, query);
      }),
    );
  }

  async #takeWhole(songs: readonly SongState[], signal: AbortSignal): Promise<void> {
    const { api } = this.#surroundings;
    const whole = await this.#decoded(songs.map(({ href }) => loadWhole(api, href, signal)));
    if (!signal.aborted) this.#player.goOverTo(new WholeSong(whole, songs.length > 1));
  }

  /** A song from its bytes, or a part and the rest side by side. */
  async #decoded(files: readonly Promise<ArrayBuffer>[]): Promise<AudioBuffer> {
    const [first, second] = await Promise.all(files.map(async (file) => this.#player.decode(await file)));
    if (first === undefined) throw new RangeError("there is nothing to decode");
    return second === undefined ? first : besideEachOther([first, second]);
  }

  #segmented(songs: readonly SongState[], signal: AbortSignal): SegmentedSong {
    const { api } = this.#surroundings;
    const segments = songs.flatMap((song) => song.segments ?? []);
    const [first] = segments;
    if (first === undefined) throw new RangeError("the song has no segments");
    return new SegmentedSong({
      duration: first.song_s,
      segmentLength: first.segment_s,
      overlap: first.overlap_s,
      apart: songs.length > 1,
      load: async (segment, wanted) => {
        const either = AbortSignal.any([signal, wanted]);
        return this.#decoded(segments.map((each) => loadSegment(api, each, segment, either)));
      },
      came: () => this.#player.segmentCame(),
      failed: (error) => {
        if (error instanceof DOMException) {
          // Safari before 18.4 does not decode Ogg Opus; the whole is FLAC.
          this.#takeWhole(songs, signal).catch((reason: unknown) => this.#notHeard(reason, this.#hearing, signal));
        } else this.#notHeard(error, this.#hearing, signal);
      },
    });
  }

  /** Tell how far the server is until the song is there. */
  async #followMaking(known: readonly SongState[], hearing: Hearing, signal: AbortSignal): Promise<void> {
    let songs = known;
    while (songs.some(({ status }) => status === "rendering")) {
      this.soundShare = Math.min(...songs.map(({ progress }) => progress));
      await new Promise((resolve) => setTimeout(resolve, SHARE_INTERVAL_MS));
      if (signal.aborted) return;
      songs = await Promise.all(
        queriesOf(hearing).map((query) => songState(this.#surroundings.api, this.id, signal, query)),
      );
    }
  }

  /** What was wanted cannot be heard: what everybody hears is heard again, or nothing where it is that. */
  #notHeard(error: unknown, hearing: Hearing, signal: AbortSignal): void {
    if (signal.aborted || isAsWritten(hearing)) this.#noSound(error, signal);
    else {
      this.#fail(error);
      this.partSound.giveUp();
      this.#hear();
    }
  }

  #noSound(error: unknown, signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#songHref = null;
    this.soundError = error instanceof ProblemError ? error.message : told.cannotPlay;
    this.#startWithSound();
  }
}
