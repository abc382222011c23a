import { ProblemError, type ReinaApi } from "../connection";
import type { SongState } from "../generated/protocol";
import {
  AnotherSoundError,
  AS_WRITTEN,
  besideEachOther,
  isAsWritten,
  loadSegment,
  loadWhole,
  plannedSong,
  queriesOf,
  SegmentedSong,
  songState,
  WholeSong,
  type Hearing,
  type SongPlayer,
} from "../sound";
import { told } from "../words/told/en";
import type { PartSound } from "./part-sound.svelte";

const SHARE_INTERVAL_MS = 1000;

/** What loading a session's song takes. */
export interface SongNeeds {
  readonly api: ReinaApi;
  /** The session's id. */
  readonly session: string;
  /** What plays it. */
  readonly player: SongPlayer;
  /** Whether the song is a recording, and was not made from the score. */
  isRecording(): boolean;
  /** The song was decoded as a whole. */
  decoded(whole: AudioBuffer): void;
  /** There will be no sound. */
  silent(): void;
  /** Show what went wrong. */
  fail(error: unknown): void;
}

/** Has a session's song loaded as this page hears it, while the server still makes it too. */
export class SongLoading {
  /** The share of the song's making that is done, while it is being made; null once it is there. */
  share = $state<number | null>(0);
  /** Why there is no sound. */
  error = $state<string | null>(null);

  readonly #needs: SongNeeds;
  readonly #partSound: PartSound;
  readonly #followed: () => number;
  /** The address of what is loaded. */
  #loaded: string | null = null;
  #song: SongState | null = null;
  #heardAs = "";
  #wanted = new AbortController();
  readonly #ended = new AbortController();

  /**
   * @param partSound how the part and everything are heard here
   * @param followed the player whose part that is, a place in the cast
   */
  constructor(needs: SongNeeds, partSound: PartSound, followed: () => number) {
    this.#needs = needs;
    this.#partSound = partSound;
    this.#followed = followed;
  }

  /** Load what the server says is the song, unless it is loaded. */
  load(song: SongState): void {
    const isSameMusic = this.#song?.href === song.href && this.#loaded !== null;
    this.#song = song;
    if (this.#loaded === song.href && this.#heardAs === this.#queries) return;
    this.#loaded = song.href;
    this.#heardAs = this.#queries;
    this.#wanted.abort();
    this.#wanted = new AbortController();
    void this.#take(song, isSameMusic, AbortSignal.any([this.#ended.signal, this.#wanted.signal]));
  }

  /** The server has made the song. */
  ready(song: SongState): void {
    if (song.segments !== null) this.share = null;
    this.load(song);
  }

  /** Have what the person wants to hear of the song: another part where another player is followed. */
  hear(): void {
    this.#needs.player.setBalance(this.#partSound.balance);
    if (this.#song !== null && this.#heardAs !== "" && this.#heardAs !== this.#queries) this.load(this.#song);
  }

  close(): void {
    this.#ended.abort();
  }

  get #hearing(): Hearing {
    return this.#needs.isRecording() ? AS_WRITTEN : this.#partSound.hearing(this.#followed());
  }

  /** What names it. */
  get #queries(): string {
    return `${queriesOf(this.#hearing).join()}?`;
  }

  async #take(known: SongState, isSameMusic: boolean, signal: AbortSignal): Promise<void> {
    const hearing = this.#hearing;
    this.share = 0;
    this.error = null;
    // What sounded before belongs to other fingers, unless it is only heard otherwise.
    if (!isSameMusic) this.#needs.player.setSong(null);
    try {
      const songs = await this.#planned(known, hearing, signal);
      const [first] = songs;
      if (first?.segments === null) await this.#takeWhole(songs, signal);
      else if (!signal.aborted) {
        this.#needs.player.goOverTo(this.#segmented(songs, signal));
        await this.#followMaking(songs, hearing, signal);
      }
    } catch (error) {
      this.#notHeard(error, hearing, signal);
    }
    if (!signal.aborted) this.share = null;
  }

  /** The songs that a hearing takes, as soon as their segments can be had. */
  #planned(known: SongState, hearing: Hearing, signal: AbortSignal): Promise<SongState[]> {
    const { api } = this.#needs;
    return Promise.all(
      queriesOf(hearing).map(async (query) => {
        const song = query === "" ? known : await songState(api, this.#needs.session, signal, query);
        return plannedSong(api, this.#needs.session, song, signal, query);
      }),
    );
  }

  async #takeWhole(songs: readonly SongState[], signal: AbortSignal): Promise<void> {
    const { api } = this.#needs;
    const whole = await this.#decoded(songs.map(({ href }) => loadWhole(api, href, signal)));
    if (signal.aborted) return;
    this.#needs.player.goOverTo(new WholeSong(whole, songs.length > 1));
    this.#needs.decoded(whole);
  }

  /** A song from its bytes, or a part and the rest side by side. */
  async #decoded(files: readonly Promise<ArrayBuffer>[]): Promise<AudioBuffer> {
    const [first, second] = await Promise.all(files.map(async (file) => this.#needs.player.decode(await file)));
    if (first === undefined) throw new RangeError("there is nothing to decode");
    return second === undefined ? first : besideEachOther([first, second]);
  }

  #segmented(songs: readonly SongState[], signal: AbortSignal): SegmentedSong {
    const { api } = this.#needs;
    const segments = songs.flatMap((song) => song.segments ?? []);
    const [[known], [first]] = [songs, segments];
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
      came: () => this.#needs.player.segmentCame(),
      failed: (error) => {
        if (error instanceof DOMException) {
          // Safari before 18.4 does not decode Ogg Opus; the whole is FLAC.
          this.#takeWhole(songs, signal).catch((reason: unknown) => this.#notHeard(reason, this.#hearing, signal));
        } else if (error instanceof AnotherSoundError && known !== undefined) {
          // Where the news of it has not come yet, it is asked for.
          void this.#take({ ...known, status: "rendering", segments: null }, true, signal);
        } else this.#notHeard(error, this.#hearing, signal);
      },
    });
  }

  /** Tell how far the server is until the song is there. */
  async #followMaking(known: readonly SongState[], hearing: Hearing, signal: AbortSignal): Promise<void> {
    let songs = known;
    while (songs.some(({ status }) => status === "rendering")) {
      this.share = Math.min(...songs.map(({ progress }) => progress));
      await new Promise((resolve) => setTimeout(resolve, SHARE_INTERVAL_MS));
      if (signal.aborted) return;
      songs = await Promise.all(
        queriesOf(hearing).map((query) => songState(this.#needs.api, this.#needs.session, signal, query)),
      );
    }
  }

  /** What was wanted cannot be heard: what everybody hears is heard again, or nothing where it is that. */
  #notHeard(error: unknown, hearing: Hearing, signal: AbortSignal): void {
    if (signal.aborted || isAsWritten(hearing)) this.#noSound(error, signal);
    else {
      this.#needs.fail(error);
      this.#partSound.giveUp();
      this.hear();
    }
  }

  #noSound(error: unknown, signal: AbortSignal): void {
    if (signal.aborted) return;
    this.#loaded = null;
    this.error = error instanceof ProblemError ? error.message : told.cannotPlay;
    this.#needs.silent();
  }
}
