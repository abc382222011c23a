import type { TransportState } from "../generated/protocol";
import { AudioOutput } from "./audio-output";
import { playClick } from "./click";
import { DriftWatch } from "./drift";
import { PartBalance } from "./part-balance";
import { PitchKeeper } from "./pitch-keeper";
import { PlaybackPath } from "./playback-path";
import { segmentAt, segmentsAhead } from "./song-parts";
import type { SongSource } from "./song-source";
import { STRETCH_LEAD_S, StretchedVoice } from "./stretched-voice";
import type { Stretcher } from "./stretcher";
import { Voice } from "./voice";

/** What the player needs to know of time. */
export interface SongTime {
  /** The page's clock, seconds (performance.now's). */
  pageNow(): number;
  /** The song time that should be heard at a time of the page's clock, seconds. */
  songTimeAt(pageTime: number): number;
  /** Whether the picture of what is to be heard now is there. */
  pictured(): boolean;
  /** Song seconds that are still counted in then, at the transport's rate, before song time runs. */
  countInAt(pageTime: number): number;
}

export type SoundState =
  /** Nothing to play. */
  | "silent"
  /** There is a song, but not yet what it sounds like at this place. */
  | "coming"
  /** The browser wants a click or a key before it lets sound out. */
  | "blocked"
  | "ready";

/** From planning a start to its sound being computed. */
const LEAD_S = 0.06;
const FADE_S = 0.012;
/** How much is heard of a place that is passed in a paused song. */
const SCRUB_S = 0.14;
/** Less than this before the song's end is not worth a start. */
const SHORTEST_START_S = 0.25;
/** After a start the output timestamp needs a moment to be true. */
const SETTLE_S = 0.6;
/** How many segments are decoded before they are needed. */
const SEGMENTS_AHEAD = 2;
/** So long a start waits for its picture: sound before it is noticed sooner than sound behind it. */
const PICTURE_WAIT_S = 1;
/** After the page has slept or has another device, a correction that would take longer than this is made at once. */
const PATIENCE_S = 0.5;
const IMPATIENT_S = 3;
/** What browsers compute at once; a source's rate changes between such quanta only. */
const QUANTUM = 128;

/**
 * Plays the song so that what is heard at any moment is the song time that the server's clock says.
 *
 * A voice is started for each play, seek, rate or loop; `check`, called every tenth of a second or so, measures what
 * is really heard, brings it back when it has drifted, and asks for what will be needed.
 */
export class SongPlayer {
  readonly #output: AudioOutput;
  readonly #time: SongTime;
  readonly #onState: (state: SoundState) => void;
  readonly #drift = new DriftWatch();
  #pitch: PitchKeeper;
  #song: SongSource | null = null;
  /** What is gone over to as soon as it can be heard here. */
  #following: SongSource | null = null;
  #balance: PartBalance | null = null;
  #balanced = 0;
  #transport: TransportState | null = null;
  #voice: Voice | StretchedVoice | null = null;
  #scrubbed: GainNode | null = null;
  #checkFrom = 0;
  #impatientUntil = 0;
  #soundsWithoutFrom = 0;
  #motions = 0;
  #state: SoundState = "silent";
  #volume = 1;
  #muted = false;

  constructor(
    time: SongTime,
    onState: (state: SoundState) => void,
    make: () => AudioContext = () => new AudioContext(),
  ) {
    this.#time = time;
    this.#onState = onState;
    this.#output = new AudioOutput(
      make,
      () => time.pageNow(),
      (renewed) => this.#outputChanged(renewed),
    );
    this.#pitch = this.#newPitch();
  }

  /** The highest sample that left the page in the last moments, 0…1. */
  get level(): number {
    return this.#output.level;
  }

  /** Whether the song keeps its pitch at every rate; where the browser computes no sound, it goes with the rate. */
  get keepsPitch(): boolean {
    return this.#pitch.keepsPitch;
  }

  /** Seconds of sound that are decoded. */
  get held(): number {
    return this.#song?.heldSeconds ?? 0;
  }

  /**
   * Decode a file.
   *
   * @throws DOMException when the browser cannot
   */
  decode(bytes: ArrayBuffer): Promise<AudioBuffer> {
    return this.#context.decodeAudioData(bytes);
  }

  /** Take a song; null takes it away. What plays goes over to it. */
  setSong(song: SongSource | null): void {
    this.#song?.close();
    if (this.#following !== song) this.#following?.close();
    this.#following = null;
    this.#song = song;
    this.#want();
    this.#tellState();
    this.#restart();
  }

  /** Take another song of the same music as soon as it can be heard here; until then what plays goes on. */
  goOverTo(song: SongSource): void {
    this.#following?.close();
    this.#following = song;
    this.#goOver();
  }

  /** Weigh the part against the rest of a song that has them apart: -1 is without it, 0 as written, 1 alone. */
  setBalance(balance: number): void {
    if (balance === this.#balanced) return;
    this.#balanced = balance;
    this.#balance?.set(balance);
  }

  /** A segment of the song has been decoded. */
  segmentCame(): void {
    this.#goOver();
    this.#tellState();
    if (this.#voice === null) this.#startWhereSilent();
    else this.#voice.extend();
  }

  /** A picture has come that sound may have waited for. */
  pictureCame(): void {
    if (this.#voice === null) this.#startWhereSilent();
  }

  /** The transport changed: play, pause or move accordingly. */
  follow(transport: TransportState): void {
    const before = this.#transport;
    this.#transport = transport;
    this.#want();
    this.#tellState();
    // An edit of the show raises the epoch too; the sound need not stutter for it.
    if (before !== null && this.#voice !== null && sameMotion(before, transport)) return;
    this.#restart();
  }

  /** Play a moment of the song from a place, seconds, unless it plays already; the moment before ends at once. */
  scrub(position: number): void {
    if (this.#song === null || this.#transport?.playing === true || position >= this.#song.duration) return;
    if (!this.#output.running) {
      void this.#output.resume();
      return;
    }
    const now = this.#context.currentTime;
    this.#scrubbed?.gain.cancelScheduledValues(now);
    this.#scrubbed?.gain.setTargetAtTime(0, now, FADE_S / 3);
    const song = this.#song;
    const segment = segmentAt(Math.max(position, 0), song);
    const buffer = song.at(segment);
    if (buffer === null) {
      song.want([segment]);
      return;
    }
    const source = new AudioBufferSourceNode(this.#context, { buffer });
    const gain = new GainNode(this.#context, { gain: 0 });
    gain.gain.setValueAtTime(0, now);
    gain.gain.linearRampToValueAtTime(1, now + FADE_S);
    gain.gain.setValueAtTime(1, now + SCRUB_S - FADE_S);
    gain.gain.linearRampToValueAtTime(0, now + SCRUB_S);
    source.connect(gain).connect(this.#inputOf(song));
    source.start(now, Math.max(position, 0) - segment * song.segmentLength + song.overlap, SCRUB_S);
    this.#scrubbed = gain;
    source.onended = () => {
      gain.disconnect();
      if (this.#scrubbed === gain) this.#scrubbed = null;
    };
  }

  /** Let sound out; to be called from a click or a key. */
  async unlock(): Promise<void> {
    await this.#output.resume();
  }

  /** Seconds by which sound comes to the ear later than the browser knows: it is asked for so much earlier. */
  setTrim(trim: number): void {
    if (trim === this.#output.trim) return;
    this.#output.trim = trim;
    if (this.#voice !== null) this.#restart();
  }

  /** The page has slept, was hidden, or plays on another device: what is wrong is put right at once. */
  wake(): void {
    this.#impatientUntil = this.#time.pageNow() + IMPATIENT_S;
    this.#checkFrom = 0;
    this.#drift.reset();
    this.#song?.loadAgain();
    if (this.#transport?.playing === true) void this.#output.resume();
    this.check();
  }

  /** Let a click be heard at a time of the page's clock, seconds, as loud as the song. */
  click(pageTime: number): void {
    const when = this.#output.heard(pageTime);
    if (this.#output.running && when > this.#context.currentTime) playClick(this.#context, this.#output.into, when);
    else void this.#output.resume();
  }

  /** 0…1. */
  setVolume(volume: number, muted: boolean): void {
    this.#volume = volume;
    this.#muted = muted;
    // Loudness is heard by ratios: the square makes the slider's middle sound like the middle.
    const gain = this.#muted ? 0 : this.#volume * this.#volume;
    this.#output.setGain(gain);
  }

  /** The song time that is heard now, seconds; null when none is. */
  heardSongTime(): number | null {
    const voice = this.#voice;
    if (voice === null || !this.#output.running) return null;
    const heard = this.#heard();
    return heard < voice.until && voice.path.countInAt(heard) === 0 ? voice.path.positionAt(heard) : null;
  }

  /** The clock that sound is scheduled on; what is not the song has a way out of its own. */
  get context(): AudioContext {
    return this.#context;
  }

  /** How often what is heard has begun, ended or been brought back: what was reckoned from `pathNow` before is old. */
  get motions(): number {
    return this.#motions;
  }

  /** Where the song is at context times, as it is heard or would be; null while it stands. */
  pathNow(): PlaybackPath | null {
    if (this.#voice !== null && !this.#voice.isOver) return this.#voice.path;
    const transport = this.#transport;
    if (transport?.playing !== true || !this.#output.running) return null;
    const heardAt = this.#context.currentTime;
    const pageTime = this.#time.pageNow() + (heardAt - this.#heard());
    const position = this.#time.songTimeAt(pageTime);
    const loop = transport.loop !== null && position < transport.loop.end_s ? transport.loop : null;
    const begins = heardAt + this.#time.countInAt(pageTime) / transport.rate;
    return new PlaybackPath(begins, position, transport.rate, loop);
  }

  /**
   * How far what is heard at a time of the page's clock is ahead of a song time, seconds of song, the shorter way
   * round a loop; null when nothing is heard.
   */
  heardAhead(songTime: number, pageTime: number): number | null {
    const voice = this.#voice;
    if (voice === null || !this.#output.running) return null;
    const heard = this.#output.heard(pageTime);
    return heard >= voice.from && heard < voice.until ? voice.path.errorAt(heard, songTime) : null;
  }

  /** How far what is heard now is ahead of the song time that should be, seconds; null when nothing is. */
  soundAhead(): number | null {
    const voice = this.#voice;
    if (voice === null || !this.#output.running) return null;
    const heard = this.#heard();
    if (voice.path.countInAt(heard) > 0) return null;
    return voice.path.errorAt(heard, this.#time.songTimeAt(this.#time.pageNow()));
  }

  /** Measure, and correct when the sound is not where it should be, or is silent where the song has sound. */
  check(): void {
    this.#goOver();
    this.#want();
    if (this.#transport?.playing === true && this.#song !== null) this.#output.look();
    this.#tellState();
    const voice = this.#voice;
    if (voice === null) {
      this.#startWhereSilent();
      return;
    }
    voice.extend();
    if (voice.isOver) {
      this.#stopVoice();
      return;
    }
    const pageTime = this.#time.pageNow();
    if (pageTime < this.#checkFrom) return;
    const error = this.soundAhead();
    if (error === null) return;
    const correction = this.#drift.read(error, voice.rate);
    const slow = correction.kind === "burst" && correction.seconds > PATIENCE_S && pageTime < this.#impatientUntil;
    if (correction.kind === "restart" || slow) this.#restart();
    else if (correction.kind === "burst") {
      const begin = this.#onGrid(this.#context.currentTime + LEAD_S, QUANTUM);
      const end = this.#onGrid(begin + correction.seconds, QUANTUM);
      voice.changeRate(begin, end, voice.rate * correction.rate);
      this.#motions += 1;
      this.#checkFrom = pageTime + LEAD_S + correction.seconds + SETTLE_S;
    }
  }

  /** Stop and give the sound device back. */
  async close(): Promise<void> {
    this.#stopVoice();
    await this.#output.close();
  }

  get #context(): AudioContext {
    return this.#output.context;
  }

  #outputChanged(renewed: boolean): void {
    if (renewed) {
      // What was scheduled is lost with its context.
      this.#voice = null;
      this.#scrubbed = null;
      this.#balance = null;
      this.#pitch = this.#newPitch();
      this.#impatientUntil = this.#time.pageNow() + IMPATIENT_S;
    }
    this.#tellState();
    this.#restart();
  }

  #newPitch(): PitchKeeper {
    return new PitchKeeper(this.#context, () => this.#startWhereSilent());
  }

  /** What was not there in time has come, or a loop has come back from behind the song's end. */
  #startWhereSilent(): void {
    if (this.#song === null || this.#transport?.playing !== true || !this.#output.running) return;
    const position = this.#position();
    if (position < this.#song.duration - SHORTEST_START_S) this.#startVoice(this.#song, this.#transport);
  }

  #restart(): void {
    this.#stopVoice();
    this.#soundsWithoutFrom = this.#time.pageNow() + PICTURE_WAIT_S;
    const transport = this.#transport;
    if (this.#song === null || transport?.playing !== true) return;
    if (!this.#output.running) {
      // Granted at once where the person has touched the page already, else once they do.
      void this.#output.resume();
      return;
    }
    this.#startVoice(this.#song, transport);
  }

  #startVoice(song: SongSource, transport: TransportState): void {
    if (!this.#time.pictured() && this.#time.pageNow() < this.#soundsWithoutFrom) return;
    const { rate } = transport;
    // At the written tempo the song is played as it is.
    const stretcher = rate === 1 ? undefined : this.#stretcherFor(song);
    if (stretcher === null) return;
    // On the samples' grid, so that nothing is interpolated at the written tempo.
    const pageTime = this.#time.pageNow();
    const lead = stretcher === undefined ? LEAD_S : STRETCH_LEAD_S;
    const soonest = this.#onGrid(this.#context.currentTime + lead);
    const heardThen = pageTime + (soonest - this.#heard());
    const position = this.#onGrid(this.#time.songTimeAt(heardThen));
    if (position >= song.duration || song.at(segmentAt(position, song)) === null) return;
    const counted = this.#time.countInAt(heardThen) / rate;
    const when = this.#onGrid(soonest + counted);
    const loop = transport.loop !== null && position < transport.loop.end_s ? transport.loop : null;
    const plan = { path: new PlaybackPath(when, position, rate, loop), position, rate, loop };
    this.#voice =
      stretcher === undefined
        ? new Voice(this.#context, song, this.#inputOf(song), plan, FADE_S)
        : new StretchedVoice(this.#context, song, stretcher, this.#inputOf(song), plan, FADE_S);
    this.#drift.reset();
    this.#motions += 1;
    this.#checkFrom = pageTime + counted + SETTLE_S;
  }

  /** What keeps the song's pitch; null while it is loaded or the song is not there, undefined where there is none. */
  #stretcherFor(song: SongSource): Stretcher | null | undefined {
    const buffer = song.at(segmentAt(this.#position(), song));
    return buffer === null ? null : this.#pitch.stretcher(buffer.numberOfChannels);
  }

  /** Where a song's sound goes: through the balance where it has the part apart, else out as it is. */
  #inputOf(song: SongSource): AudioNode {
    if (!song.apart) return this.#output.into;
    this.#balance ??= new PartBalance(this.#context, this.#output.into, this.#balanced);
    return this.#balance.input;
  }

  #goOver(): void {
    const song = this.#following;
    if (song === null) return;
    const position = this.#position();
    song.want(segmentsAhead(position, this.#transport?.loop ?? null, song, SEGMENTS_AHEAD));
    const isThere = position >= song.duration || song.at(segmentAt(position, song)) !== null;
    if (this.#song === null || isThere) this.setSong(song);
  }

  #stopVoice(): void {
    if (this.#voice !== null) this.#motions += 1;
    this.#voice?.stop(FADE_S);
    this.#voice = null;
  }

  /** Have decoded what is heard here and soon. */
  #want(): void {
    const song = this.#song;
    song?.want(segmentsAhead(this.#position(), this.#transport?.loop ?? null, song, SEGMENTS_AHEAD));
  }

  /** Where the song is now, seconds; 0 before the transport is known. */
  #position(): number {
    return this.#transport === null ? 0 : Math.max(this.#time.songTimeAt(this.#time.pageNow()), 0);
  }

  /** A time taken to whole samples of the device, or to whole multiples of some of them. */
  #onGrid(seconds: number, samples = 1): number {
    const step = samples / this.#context.sampleRate;
    return Math.round(seconds / step) * step;
  }

  #heard(): number {
    return this.#output.heard();
  }

  #tellState(): void {
    const state = this.#stateNow();
    if (state === this.#state) return;
    this.#state = state;
    this.#onState(state);
  }

  #stateNow(): SoundState {
    const song = this.#song;
    if (song === null) return "silent";
    const position = this.#position();
    if (position < song.duration && song.at(segmentAt(position, song)) === null) return "coming";
    return this.#output.running ? "ready" : "blocked";
  }
}

/** Whether both transports say the same song time for every moment to come. */
export function sameMotion(a: TransportState, b: TransportState): boolean {
  if (a.playing !== b.playing || a.rate !== b.rate) return false;
  if (a.loop?.start_s !== b.loop?.start_s || a.loop?.end_s !== b.loop?.end_s) return false;
  if (a.loop?.count_in_s !== b.loop?.count_in_s || a.count_in_s > 0 || b.count_in_s > 0) return false;
  const moved = b.song_time_s - a.song_time_s - (b.server_time_s - a.server_time_s) * a.rate;
  return a.playing && Math.abs(moved) < 0.001;
}
