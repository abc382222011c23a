import type { Loop } from "../generated/protocol";
import { countInWithin, foldIntoLoop, type PlaybackPath } from "./playback-path";
import { partFrom } from "./song-parts";
import type { SongSource } from "./song-source";

/** Segments are faded into each other over this much of the song, seconds; both hold the same sound there. */
export const CROSSFADE_S = 0.02;
/** So far ahead of its time sound is scheduled: timers of a page in the background come once a second. */
export const SCHEDULED_AHEAD_S = 4;
/** What would begin sooner than this begins too late. */
export const MIN_LEAD_S = 0.01;

interface Scheduled {
  readonly source: AudioBufferSourceNode;
  readonly gain: GainNode;
  /** Places in the song, counted on over the loop's end: where it begins and where it is faded out or ends. */
  readonly begin: number;
  readonly end: number;
  readonly joinsBefore: boolean;
  readonly joinsNext: boolean;
}

/**
 * A song that plays from one place on: one AudioBufferSource a part, placed on the path so that each begins where the
 * one before ends, and fades into it where both are the same sound.
 */
export class Voice {
  readonly path: PlaybackPath;
  readonly rate: number;
  /** Context time at which it begins. */
  readonly from: number;
  readonly #context: AudioContext;
  readonly #song: SongSource;
  readonly #loop: Loop | null;
  readonly #gain: GainNode;
  readonly #scheduled = new Set<Scheduled>();
  /** Up to where it is scheduled, counted on over the loop's end. */
  #next: number;
  #joins = false;
  #finished = false;

  /** Begins where its path does, faded in. */
  constructor(
    context: AudioContext,
    song: SongSource,
    into: AudioNode,
    { path, position, rate, loop }: { path: PlaybackPath; position: number; rate: number; loop: Loop | null },
    fade: number,
  ) {
    this.#context = context;
    this.#song = song;
    this.path = path;
    this.rate = rate;
    this.#loop = loop;
    this.#next = position;
    const when = path.timeAt(position);
    this.from = when;
    this.#gain = new GainNode(context, { gain: 0 });
    this.#gain.gain.setValueAtTime(0, when);
    this.#gain.gain.linearRampToValueAtTime(1, when + fade);
    this.#gain.connect(into);
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

  /** Schedule what is due soon and is decoded. */
  extend(): void {
    const now = this.#context.currentTime;
    while (!this.#finished && this.until < now + SCHEDULED_AHEAD_S) {
      const counted = countInWithin(this.#next, this.#loop);
      if (counted > 0) {
        this.#next += counted;
        this.#joins = false;
      }
      const position = foldIntoLoop(this.#next, this.#loop);
      const part = partFrom(position, this.#loop, this.#song);
      if (part === null) {
        // A loop that reaches beyond the song's end is silent there, and comes back.
        if (this.#loop === null || this.#loop.start_s >= this.#song.duration) this.#finished = true;
        else this.#next += this.#loop.end_s - position;
        this.#joins = false;
        continue;
      }
      const buffer = this.#song.at(part.segment);
      if (buffer === null || this.until < now + MIN_LEAD_S) return;
      const before = this.#joins ? CROSSFADE_S / 2 : 0;
      const after = part.joinsNext ? CROSSFADE_S / 2 : 0;
      const begin = this.#next - before;
      const end = this.#next + (part.end - part.begin) + after;
      const offset = part.begin - before - part.segment * this.#song.segmentLength + this.#song.overlap;
      this.#schedule(buffer, offset, { begin, end, joinsBefore: this.#joins, joinsNext: part.joinsNext });
      this.#next += part.end - part.begin;
      this.#joins = part.joinsNext;
    }
  }

  /** Play at another rate between two context times, both of them later than now. */
  changeRate(begin: number, end: number, rate: number): void {
    this.path.changeRate(begin, rate);
    this.path.changeRate(end, this.rate);
    for (const each of [...this.#scheduled]) {
      if (this.path.timeAt(each.begin) > begin) this.#takeBack(each);
      else {
        for (const change of this.path.changesFrom(begin - 1e-9)) {
          each.source.playbackRate.setValueAtTime(change.rate, change.from);
        }
        if (each.joinsNext && this.path.timeAt(each.end - CROSSFADE_S) > begin) {
          each.gain.gain.cancelScheduledValues(begin);
          this.#fadeOut(each);
        }
      }
    }
    this.extend();
  }

  /** Fade out and end. */
  stop(fade: number): void {
    const now = this.#context.currentTime;
    this.#finished = true;
    this.#gain.gain.cancelScheduledValues(now);
    this.#gain.gain.setTargetAtTime(0, now, fade / 3);
    for (const { source } of this.#scheduled) source.stop(now + 2 * fade);
  }

  #schedule(buffer: AudioBuffer, offset: number, place: Omit<Scheduled, "source" | "gain">): void {
    const when = this.path.timeAt(place.begin);
    const source = new AudioBufferSourceNode(this.#context, { buffer, playbackRate: this.path.rateAt(when) });
    for (const { from, rate } of this.path.changesFrom(when)) source.playbackRate.setValueAtTime(rate, from);
    const gain = new GainNode(this.#context, { gain: place.joinsBefore ? 0 : 1 });
    const scheduled = { source, gain, ...place };
    if (place.joinsBefore) {
      gain.gain.setValueAtTime(0, when);
      gain.gain.linearRampToValueAtTime(1, this.path.timeAt(place.begin + CROSSFADE_S));
    }
    if (place.joinsNext) this.#fadeOut(scheduled);
    source.connect(gain).connect(this.#gain);
    source.start(when, offset, place.end - place.begin);
    this.#scheduled.add(scheduled);
    source.onended = () => {
      gain.disconnect();
      this.#scheduled.delete(scheduled);
      if (this.#finished && this.#scheduled.size === 0) this.#gain.disconnect();
    };
  }

  #fadeOut({ gain, end }: Scheduled): void {
    gain.gain.setValueAtTime(1, this.path.timeAt(end - CROSSFADE_S));
    gain.gain.linearRampToValueAtTime(0, this.path.timeAt(end));
  }

  /** Have what has not begun scheduled anew. */
  #takeBack(each: Scheduled): void {
    const begin = each.begin + (each.joinsBefore ? CROSSFADE_S / 2 : 0);
    if (begin < this.#next) {
      this.#next = begin;
      this.#joins = each.joinsBefore;
      this.#finished = false;
    }
    each.source.onended = null;
    each.source.stop();
    each.gain.disconnect();
    this.#scheduled.delete(each);
  }
}
