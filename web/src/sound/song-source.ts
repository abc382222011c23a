import type { SongShape } from "./song-parts";

/** A song as it is decoded, in segments. */
export interface SongSource extends SongShape {
  /** How much of the song each segment holds before its begin, seconds, and again behind its end. */
  readonly overlap: number;
  /** Seconds of sound that are decoded. */
  readonly heldSeconds: number;
  /** Its channels are a part's two and the rest's two. */
  readonly apart: boolean;
  /** A segment that is decoded; null while it is not. */
  at(segment: number): AudioBuffer | null;
  /** Have these decoded, the first most urgently, and others forgotten as room is needed. */
  want(segments: readonly number[]): void;
  /** Ask anew for what is being loaded, as after a sleep: its connection may be gone without a word. */
  loadAgain(): void;
  close(): void;
}

/** A song that was decoded as a whole. */
export class WholeSong implements SongSource {
  readonly overlap = 0;
  readonly apart: boolean;
  readonly #buffer: AudioBuffer;

  constructor(buffer: AudioBuffer, apart = false) {
    this.#buffer = buffer;
    this.apart = apart;
  }

  get duration(): number {
    return this.#buffer.duration;
  }

  get segmentLength(): number {
    return this.#buffer.duration;
  }

  get heldSeconds(): number {
    return this.#buffer.duration;
  }

  at(segment: number): AudioBuffer | null {
    return segment === 0 ? this.#buffer : null;
  }

  want(): void {
    return;
  }

  loadAgain(): void {
    return;
  }

  close(): void {
    return;
  }
}

/** What a segmented song is made of. */
export interface SegmentedSongParts extends SongShape {
  readonly overlap: number;
  readonly apart?: boolean;
  /** Get and decode a segment; rejects where that cannot be. */
  load(segment: number, signal: AbortSignal): Promise<AudioBuffer>;
  /** A segment is there. */
  came(): void;
  /** A segment could not be had; none is asked for any more. */
  failed(error: unknown): void;
}

/** So many decoded segments are kept: what is heard, what follows, a loop's begin, and what was heard last. */
export const MAX_HELD = 6;

/** A song of which a few segments at a time are decoded, so that memory does not grow with its length. */
export class SegmentedSong implements SongSource {
  readonly duration: number;
  readonly segmentLength: number;
  readonly overlap: number;
  readonly apart: boolean;
  readonly #parts: SegmentedSongParts;
  /** In the order in which they were wanted last. */
  readonly #held = new Map<number, AudioBuffer>();
  #wanted: readonly number[] = [];
  #loading: { readonly segment: number; readonly abort: AbortController } | null = null;
  #closed = false;

  constructor(parts: SegmentedSongParts) {
    this.#parts = parts;
    this.duration = parts.duration;
    this.segmentLength = parts.segmentLength;
    this.overlap = parts.overlap;
    this.apart = parts.apart ?? false;
  }

  get heldSeconds(): number {
    return [...this.#held.values()].reduce((seconds, buffer) => seconds + buffer.duration, 0);
  }

  at(segment: number): AudioBuffer | null {
    return this.#held.get(segment) ?? null;
  }

  want(segments: readonly number[]): void {
    this.#wanted = segments;
    for (const segment of [...segments].reverse()) {
      const buffer = this.#held.get(segment);
      if (buffer === undefined) continue;
      this.#held.delete(segment);
      this.#held.set(segment, buffer);
    }
    const loading = this.#loading;
    if (loading !== null && !segments.includes(loading.segment)) loading.abort.abort();
    this.#loadNext();
  }

  loadAgain(): void {
    this.#loading?.abort.abort();
  }

  close(): void {
    this.#closed = true;
    this.#loading?.abort.abort();
    this.#held.clear();
  }

  #loadNext(): void {
    const segment = this.#wanted.find((each) => !this.#held.has(each));
    if (this.#closed || this.#loading !== null || segment === undefined) return;
    const abort = new AbortController();
    this.#loading = { segment, abort };
    void this.#load(segment, abort.signal);
  }

  async #load(segment: number, signal: AbortSignal): Promise<void> {
    try {
      const buffer = await this.#parts.load(segment, signal);
      if (this.#closed) return;
      this.#held.set(segment, buffer);
      for (const oldest of this.#held.keys()) {
        if (this.#held.size <= MAX_HELD) break;
        if (!this.#wanted.includes(oldest)) this.#held.delete(oldest);
      }
      this.#parts.came();
    } catch (error) {
      if (!signal.aborted && !this.#closed) {
        this.#closed = true;
        this.#parts.failed(error);
      }
    }
    this.#loading = null;
    this.#loadNext();
  }
}
