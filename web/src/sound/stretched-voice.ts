import type { Loop } from "../generated/protocol";
import { countInWithin, foldIntoLoop, type PlaybackPath } from "./playback-path";
import { samplesOf } from "./song-samples";
import { partFrom, segmentAt, type Part } from "./song-parts";
import type { SongSource } from "./song-source";
import type { Stretcher } from "./stretcher";
import { MIN_LEAD_S, SCHEDULED_AHEAD_S } from "./voice";

/** From planning a start to its being heard: the stretcher needs half a block of what follows, and half a block's time. */
export const STRETCH_LEAD_S = 0.15;
/** So much before its place is stretched as well, unheard, so that it begins at full strength, seconds. */
const RUN_UP_S = 0.1;
/** So much is given to the stretcher at once, seconds of song. */
const LONGEST_PIECE_S = 2;

/**
 * A song that plays from one place on at another rate and its own pitch.
 *
 * As a `Voice` it is placed on a path, and says by it what is heard when. The stretcher has one row of samples: the
 * song as it is heard, counted on over a loop's end, so that all it has to know is where in it which time is.
 */
export class StretchedVoice {
  readonly path: PlaybackPath;
  readonly rate: number;
  /** Context time at which it begins to be heard. */
  readonly from: number;
  readonly #context: BaseAudioContext;
  readonly #song: SongSource;
  readonly #stretcher: Stretcher;
  readonly #loop: Loop | null;
  readonly #gain: GainNode;
  /** The place that the stretcher's row begins at, and up to where it reaches, counted on over the loop's end. */
  readonly #origin: number;
  #next: number;
  #joins = false;
  #finished = false;
  #burst: ReturnType<typeof setTimeout> | undefined;

  /** Begins where its path does, faded in. The stretcher is its own until another voice begins. */
  constructor(
    context: BaseAudioContext,
    song: SongSource,
    stretcher: Stretcher,
    into: AudioNode,
    { path, position, rate, loop }: { path: PlaybackPath; position: number; rate: number; loop: Loop | null },
    fade: number,
  ) {
    this.#context = context;
    this.#song = song;
    this.#stretcher = stretcher;
    this.path = path;
    this.rate = rate;
    this.#loop = loop;
    const when = path.timeAt(position);
    this.from = when;
    const runUp = this.#runUp(position);
    this.#origin = position - runUp;
    this.#next = this.#origin;
    this.#gain = new GainNode(context, { gain: 0 });
    this.#gain.gain.setValueAtTime(0, when);
    this.#gain.gain.linearRampToValueAtTime(1, when + fade);
    stretcher.node.connect(this.#gain).connect(into);
    stretcher.begin(rate);
    stretcher.schedule({ output: when - RUN_UP_S, active: true, input: runUp - RUN_UP_S * rate, rate });
    this.extend();
  }

  /** Context time up to which there is something to be heard. */
  get until(): number {
    return this.path.timeAt(this.#next);
  }

  /** The song has come to its end, or to a place that was not decoded in time. */
  get isOver(): boolean {
    return this.until <= this.#context.currentTime;
  }

  /** Give the stretcher what is due soon and is decoded. */
  extend(): void {
    const now = this.#context.currentTime;
    while (!this.#finished && this.until < now + SCHEDULED_AHEAD_S) {
      const counted = countInWithin(this.#next, this.#loop);
      if (counted > 0) {
        this.#giveSilence(counted);
        continue;
      }
      const position = foldIntoLoop(this.#next, this.#loop);
      const part = partFrom(position, this.#loop, this.#song);
      if (part !== null) {
        const isLate = this.#next > this.#origin && this.until < now + MIN_LEAD_S;
        if (this.#song.at(part.segment) === null || isLate) return;
        this.#give(part);
      } else if (this.#loop === null || this.#loop.start_s >= this.#song.duration) this.#finished = true;
      else this.#giveSilence(this.#loop.end_s - position);
    }
  }

  /** Play at another rate between two context times, both of them later than now. */
  changeRate(begin: number, end: number, rate: number): void {
    this.path.changeRate(begin, rate);
    this.path.changeRate(end, this.rate);
    this.#stretcher.schedule({ output: begin, rate });
    // The stretcher holds one change that is to come; one that is told late leads to the same place.
    const told = (end + begin) / 2 - this.#context.currentTime;
    this.#burst = setTimeout(() => this.#stretcher.schedule({ output: end, rate: this.rate }), told * 1000);
  }

  /** Fade out and end. */
  stop(fade: number): void {
    const now = this.#context.currentTime;
    this.#finished = true;
    clearTimeout(this.#burst);
    this.#gain.gain.cancelScheduledValues(now);
    this.#gain.gain.setTargetAtTime(0, now, fade / 3);
    this.#stretcher.schedule({ output: now + 2 * fade, active: false });
    setTimeout(() => {
      this.#stretcher.node.disconnect(this.#gain);
      this.#gain.disconnect();
    }, 4000 * fade);
  }

  /** How much of a place's segment lies before it, at most what the run-up takes, seconds. */
  #runUp(position: number): number {
    const begin = segmentAt(position, this.#song) * this.#song.segmentLength;
    return Math.min(Math.max(position - begin, 0), RUN_UP_S * Math.max(this.rate, 1));
  }

  #give(part: Part): void {
    const length = Math.min(part.end - part.begin, LONGEST_PIECE_S);
    const before = this.#joins ? this.#song.at(part.segment - 1) : null;
    this.#stretcher.add(samplesOf(this.#song, part, this.#samplesOf(length), before));
    this.#next += length;
    this.#joins = part.joinsNext && length === part.end - part.begin;
  }

  #giveSilence(length: number): void {
    this.#stretcher.add([new Float32Array(this.#samplesOf(length))]);
    this.#next += length;
    this.#joins = false;
  }

  /** How many samples the next seconds are, so that the row as a whole is as long as what it holds. */
  #samplesOf(length: number): number {
    const at = (place: number): number => Math.round((place - this.#origin) * this.#context.sampleRate);
    return at(this.#next + length) - at(this.#next);
  }
}
