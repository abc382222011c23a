import type { Click } from "../state/beats";
import type { Piece, PlaybackPath } from "./playback-path";

/** What a metronome needs to know of what it clicks to. */
export interface MetronomeSong {
  /** Where the song is at context times to come, whether or not it is heard; null while it stands. */
  pathNow(): PlaybackPath | null;
  /** The clicks of a piece of the path, in their order; none where it is not to click. */
  clicksIn(piece: Piece): readonly Click[];
}

/** So far ahead clicks are scheduled: timers of a page that is not seen, or draws with effort, come once a second. */
const AHEAD_S = 1.6;
/** What would click sooner than this clicks too late. */
const MIN_LEAD_S = 0.004;
/** No two clicks of a song are closer. */
const SHORTEST_GAP_S = 0.03;
const VOLUME_GLIDE_S = 0.03;
/** Pitch and loudness: a bar's first beat is told from the others by both. */
const SOUNDS: Readonly<Record<Click["kind"], readonly [hertz: number, gain: number]>> = {
  bar: [1760, 0.9],
  beat: [1175, 0.6],
  division: [880, 0.3],
};
const ATTACK_S = 0.001;
const DECAY_S = 0.045;

interface Scheduled {
  readonly when: number;
  readonly source: OscillatorNode;
}

/** Clicks with the song that is heard, on the same clock, and goes its own way out: it clicks while the song is muted. */
export class Metronome {
  readonly #present: () => AudioContext;
  readonly #song: MetronomeSong;
  #held: AudioContext;
  #way: GainNode;
  #volume = 1;
  #scheduled: Scheduled[] = [];
  #last = -Infinity;
  #motion: unknown = null;

  /** @param present gives the context that sound goes to; with another device that is another one. */
  constructor(present: () => AudioContext, song: MetronomeSong) {
    this.#present = present;
    this.#song = song;
    this.#held = present();
    this.#way = this.#wayOut(this.#held);
  }

  /** Its way out, for what else is as loud as it. */
  get out(): GainNode {
    const context = this.#present();
    if (this.#held !== context) {
      this.#held = context;
      this.#way = this.#wayOut(context);
      this.#scheduled = [];
      this.#last = -Infinity;
    }
    return this.#way;
  }

  get #context(): AudioContext {
    return this.#present();
  }

  #wayOut(context: AudioContext): GainNode {
    const way = context.createGain();
    way.gain.value = this.#volume * this.#volume;
    way.connect(context.destination);
    return way;
  }

  /** 0…1. */
  setVolume(volume: number): void {
    this.#volume = volume;
    this.out.gain.setTargetAtTime(volume * volume, this.#context.currentTime, VOLUME_GLIDE_S);
  }

  /**
   * Schedule what is due soon; to be called every tenth of a second or so.
   *
   * @param motion another value whenever the song moves otherwise than before, or other clicks are wanted: what was
   *   scheduled is taken back then.
   */
  check(motion: unknown): void {
    const now = this.#context.currentTime;
    if (motion !== this.#motion) {
      this.#motion = motion;
      this.#takeBack(now);
    }
    this.#scheduled = this.#scheduled.filter(({ when }) => when > now);
    const path = this.#song.pathNow();
    if (path === null) {
      this.#takeBack(now);
      return;
    }
    const from = Math.max(now + MIN_LEAD_S, this.#last + SHORTEST_GAP_S);
    if (from >= now + AHEAD_S) return;
    for (const piece of path.piecesBetween(path.unfoldedAt(from), path.unfoldedAt(now + AHEAD_S))) {
      for (const { songTime, kind } of this.#song.clicksIn(piece)) {
        const when = path.timeAt(songTime + piece.shift);
        if (when >= from) this.#click(when, kind);
      }
    }
  }

  #click(when: number, kind: Click["kind"]): void {
    const [frequency, loudness] = SOUNDS[kind];
    const source = new OscillatorNode(this.#context, { frequency, type: "triangle" });
    const gain = new GainNode(this.#context, { gain: 0 });
    gain.gain.setValueAtTime(0, when);
    gain.gain.linearRampToValueAtTime(loudness, when + ATTACK_S);
    gain.gain.setTargetAtTime(0, when + ATTACK_S, DECAY_S / 3);
    source.connect(gain).connect(this.out);
    source.onended = () => gain.disconnect();
    source.start(when);
    source.stop(when + 2 * DECAY_S);
    this.#scheduled.push({ when, source });
    this.#last = when;
  }

  #takeBack(now: number): void {
    for (const { when, source } of this.#scheduled) if (when > now) source.stop();
    this.#scheduled = [];
    this.#last = Math.min(this.#last, now);
  }
}
