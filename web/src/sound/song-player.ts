import type { TransportState } from "../generated/protocol";
import { DriftWatch } from "./drift";
import { heardContextTime } from "./heard-time";
import { PlaybackPath } from "./playback-path";

/** What the player needs to know of time. */
export interface SongTime {
  /** The page's clock, seconds (performance.now's). */
  pageNow(): number;
  /** The song time that should be heard at a time of the page's clock, seconds. */
  songTimeAt(pageTime: number): number;
}

export type SoundState =
  /** Nothing to play yet. */
  | "silent"
  /** The browser wants a click or a key before it lets sound out. */
  | "blocked"
  | "ready";

interface Voice {
  readonly source: AudioBufferSourceNode;
  readonly gain: GainNode;
  readonly path: PlaybackPath;
  readonly rate: number;
}

/** From planning a start to its sound being computed. */
const LEAD_S = 0.06;
const FADE_S = 0.012;
/** How much is heard of a place that is passed in a paused song. */
const SCRUB_S = 0.14;
/** Less than this before the song's end is not worth a start. */
const SHORTEST_START_S = 0.25;
/** After a start the output timestamp needs a moment to be true. */
const SETTLE_S = 0.6;
const VOLUME_GLIDE_S = 0.03;

/**
 * Plays the decoded song so that what is heard at any moment is the song time that the server's clock says.
 *
 * One AudioBufferSource is scheduled for each play, seek, rate or loop; `check`, called every tenth of a second or so,
 * measures what is really heard and brings it back when it has drifted.
 */
export class SongPlayer {
  readonly #context: AudioContext;
  readonly #master: GainNode;
  readonly #time: SongTime;
  readonly #onState: (state: SoundState) => void;
  readonly #drift = new DriftWatch();
  #song: AudioBuffer | null = null;
  #transport: TransportState | null = null;
  #voice: Voice | null = null;
  #scrubbed: GainNode | null = null;
  #songs = 0;
  #checkFrom = 0;
  #state: SoundState = "silent";
  #volume = 1;
  #muted = false;

  constructor(time: SongTime, onState: (state: SoundState) => void, context = new AudioContext()) {
    this.#time = time;
    this.#onState = onState;
    this.#context = context;
    this.#master = context.createGain();
    this.#master.connect(context.destination);
    context.onstatechange = () => {
      this.#tellState();
      this.#restart();
    };
  }

  /** Seconds of the song that is loaded; 0 without one. */
  get songDuration(): number {
    return this.#song?.duration ?? 0;
  }

  /**
   * Decode and take a song; null takes it away. What plays goes over to it.
   *
   * @throws DOMException when the browser cannot decode it
   */
  async setSong(bytes: ArrayBuffer | null): Promise<void> {
    const turn = ++this.#songs;
    const song = bytes === null ? null : await this.#context.decodeAudioData(bytes);
    // Decoding takes a moment; what was set meanwhile counts.
    if (turn !== this.#songs) return;
    this.#song = song;
    this.#tellState();
    this.#restart();
  }

  /** The transport changed: play, pause or move accordingly. */
  follow(transport: TransportState): void {
    const before = this.#transport;
    this.#transport = transport;
    // An edit of the show raises the epoch too; the sound need not stutter for it.
    if (before !== null && this.#voice !== null && sameMotion(before, transport)) return;
    this.#restart();
  }

  /** Play a moment of the song from a place, seconds, unless it plays already; the moment before ends at once. */
  scrub(position: number): void {
    if (this.#song === null || this.#transport?.playing === true || position >= this.#song.duration) return;
    if (this.#context.state !== "running") {
      void this.#context.resume();
      return;
    }
    const now = this.#context.currentTime;
    this.#scrubbed?.gain.cancelScheduledValues(now);
    this.#scrubbed?.gain.setTargetAtTime(0, now, FADE_S / 3);
    const source = new AudioBufferSourceNode(this.#context, { buffer: this.#song });
    const gain = new GainNode(this.#context, { gain: 0 });
    gain.gain.setValueAtTime(0, now);
    gain.gain.linearRampToValueAtTime(1, now + FADE_S);
    gain.gain.setValueAtTime(1, now + SCRUB_S - FADE_S);
    gain.gain.linearRampToValueAtTime(0, now + SCRUB_S);
    source.connect(gain).connect(this.#master);
    source.start(now, Math.max(position, 0), SCRUB_S);
    this.#scrubbed = gain;
    source.onended = () => {
      gain.disconnect();
      if (this.#scrubbed === gain) this.#scrubbed = null;
    };
  }

  /** Let sound out; to be called from a click or a key. */
  async unlock(): Promise<void> {
    if (this.#context.state !== "running") await this.#context.resume();
  }

  /** 0…1. */
  setVolume(volume: number, muted: boolean): void {
    this.#volume = volume;
    this.#muted = muted;
    // Loudness is heard by ratios: the square makes the slider's middle sound like the middle.
    const gain = this.#muted ? 0 : this.#volume * this.#volume;
    this.#master.gain.setTargetAtTime(gain, this.#context.currentTime, VOLUME_GLIDE_S);
  }

  /** The song time that is heard now, seconds; null when none is. */
  heardSongTime(): number | null {
    const voice = this.#voice;
    return voice === null || this.#context.state !== "running" ? null : voice.path.positionAt(this.#heard());
  }

  /** How far what is heard now is ahead of the song time that should be, seconds; null when nothing is. */
  soundAhead(): number | null {
    const voice = this.#voice;
    if (voice === null || this.#context.state !== "running") return null;
    return voice.path.errorAt(this.#heard(), this.#time.songTimeAt(this.#time.pageNow()));
  }

  /** Measure, and correct when the sound is not where it should be, or is silent where the song has sound. */
  check(): void {
    const voice = this.#voice;
    if (voice === null) {
      this.#resumeAfterSilence();
      return;
    }
    const pageTime = this.#time.pageNow();
    if (pageTime < this.#checkFrom) return;
    const error = this.soundAhead();
    if (error === null) return;
    const correction = this.#drift.read(error, voice.rate);
    if (correction.kind === "restart") this.#restart();
    else if (correction.kind === "burst") {
      const begin = this.#context.currentTime + LEAD_S;
      this.#setRate(voice, begin, voice.rate * correction.rate);
      this.#setRate(voice, begin + correction.seconds, voice.rate);
      this.#checkFrom = pageTime + LEAD_S + correction.seconds + SETTLE_S;
    }
  }

  /** Stop and give the sound device back. */
  async close(): Promise<void> {
    this.#stopVoice();
    this.#context.onstatechange = null;
    await this.#context.close();
  }

  /** A loop that reaches beyond the song's end comes back from there. */
  #resumeAfterSilence(): void {
    if (this.#song === null || this.#transport?.playing !== true || this.#context.state !== "running") return;
    const position = this.#time.songTimeAt(this.#time.pageNow());
    if (position < this.#song.duration - SHORTEST_START_S) this.#startVoice(this.#song, this.#transport);
  }

  #restart(): void {
    this.#stopVoice();
    const transport = this.#transport;
    if (this.#song === null || transport?.playing !== true) return;
    if (this.#context.state !== "running") {
      // Granted at once where the person has touched the page already, else once they do.
      void this.#context.resume();
      return;
    }
    this.#startVoice(this.#song, transport);
  }

  #startVoice(song: AudioBuffer, transport: TransportState): void {
    const when = this.#context.currentTime + LEAD_S;
    const pageTime = this.#time.pageNow();
    const position = this.#time.songTimeAt(pageTime + (when - this.#heard()));
    if (position >= song.duration) return;
    const loop = transport.loop !== null && position < transport.loop.end_s ? transport.loop : null;
    const source = new AudioBufferSourceNode(this.#context, { buffer: song, playbackRate: transport.rate });
    if (loop !== null && loop.end_s <= song.duration) {
      source.loop = true;
      source.loopStart = loop.start_s;
      source.loopEnd = loop.end_s;
    }
    const gain = new GainNode(this.#context, { gain: 0 });
    gain.gain.setValueAtTime(0, when);
    gain.gain.linearRampToValueAtTime(1, when + FADE_S);
    source.connect(gain).connect(this.#master);
    source.start(when, position);
    const path = new PlaybackPath(when, position, transport.rate, loop);
    const voice = { source, gain, path, rate: transport.rate };
    this.#voice = voice;
    source.onended = () => {
      gain.disconnect();
      if (this.#voice === voice) this.#voice = null;
    };
    this.#drift.reset();
    this.#checkFrom = pageTime + SETTLE_S;
  }

  #stopVoice(): void {
    const voice = this.#voice;
    this.#voice = null;
    if (voice === null) return;
    const now = this.#context.currentTime;
    voice.gain.gain.cancelScheduledValues(now);
    voice.gain.gain.setTargetAtTime(0, now, FADE_S / 3);
    voice.source.stop(now + 2 * FADE_S);
  }

  #setRate(voice: Voice, at: number, rate: number): void {
    voice.source.playbackRate.setValueAtTime(rate, at);
    voice.path.changeRate(at, rate);
  }

  #heard(): number {
    const stamp = this.#context.getOutputTimestamp();
    return heardContextTime({
      pageTime: this.#time.pageNow(),
      currentTime: this.#context.currentTime,
      outputLatency: this.#context.outputLatency,
      baseLatency: this.#context.baseLatency,
      outputContextTime: stamp.contextTime,
      outputPageTime: stamp.performanceTime === undefined ? undefined : stamp.performanceTime / 1000,
    });
  }

  #tellState(): void {
    const state = this.#song === null ? "silent" : this.#context.state === "running" ? "ready" : "blocked";
    if (state === this.#state) return;
    this.#state = state;
    this.#onState(state);
  }
}

/** Whether both transports say the same song time for every moment to come. */
function sameMotion(a: TransportState, b: TransportState): boolean {
  if (a.playing !== b.playing || a.rate !== b.rate) return false;
  if (a.loop?.start_s !== b.loop?.start_s || a.loop?.end_s !== b.loop?.end_s) return false;
  const moved = b.song_time_s - a.song_time_s - (b.server_time_s - a.server_time_s) * a.rate;
  return a.playing && Math.abs(moved) < 0.001;
}
