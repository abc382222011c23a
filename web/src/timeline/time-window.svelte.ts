import type { LoopSpan } from "./loop-span";

/** Pixels that a second takes, at most and at least. */
const CLOSEST = 4000;
const FURTHEST = 0.5;
/** Room before the first second, pixels. */
const MARGIN = 12;
/** From here on the playhead has not come there by playing, seconds. */
const JUMP_S = 0.4;

/** The span of song time that is on screen. */
export class TimeWindow {
  /** Song time at the left edge, seconds. */
  from = $state(0);
  /** Pixels a second. */
  scale = $state(60);
  width = $state(0);
  /** Seconds that there are to see. */
  duration = $state(1);
  readonly #tight: boolean;
  #followed: { readonly songTime: number; readonly playing: boolean } | null = null;

  /** @param tight whether nothing but the piece comes on screen: no air beside it, and no zooming out beyond it. */
  constructor({ tight = false }: { tight?: boolean } = {}) {
    this.#tight = tight;
  }

  /** Song time at the right edge, seconds. */
  get to(): number {
    return this.from + this.width / this.scale;
  }

  /** Whether the whole piece is on screen, as large as it can be. */
  get showsAll(): boolean {
    return Math.abs(this.scale / this.#whole() - 1) < 1e-6;
  }

  xOf(songTime: number): number {
    return (songTime - this.from) * this.scale;
  }

  timeAt(x: number): number {
    return this.from + x / this.scale;
  }

  /** Take the place and the length that there are; what showed all still does. */
  resize(width: number, duration: number): void {
    if (width === this.width && duration === this.duration) return;
    const all = this.width <= 0 || this.showsAll;
    this.width = width;
    this.duration = duration;
    if (all) this.showAll();
    else this.zoom(1, 0);
  }

  /** Zoom by a factor; the time at `x`, pixels, stays where it is. */
  zoom(factor: number, x = this.width / 2): void {
    const held = this.timeAt(x);
    this.scale = Math.min(Math.max(this.scale * factor, this.#least()), CLOSEST);
    this.from = this.#bounded(held - x / this.scale);
  }

  /** Move by pixels: to later times for positive ones. */
  pan(pixels: number): void {
    this.from = this.#bounded(this.from + pixels / this.scale);
  }

  /** Show a span, seconds, with a little air around it. */
  show(start: number, end: number): void {
    if (this.width <= 0) return;
    const room = Math.max(this.width - 2 * this.#margin, 1);
    this.scale = Math.min(Math.max(room / Math.max(end - start, 1e-3), this.#least()), CLOSEST);
    this.from = this.#bounded((start + end) / 2 - this.width / this.scale / 2);
  }

  showAll(): void {
    this.show(0, this.duration);
  }

  /** Bring a time into view where it is not. */
  reveal(songTime: number): void {
    if (!this.#sees(songTime)) this.from = this.#bounded(songTime - (this.width / this.scale) * 0.1);
  }

  /**
   * Keep the playhead in view where it leaves it by itself, is put elsewhere or sets out. Who moves away from it then
   * stays there, also while a loop brings it back again and again.
   *
   * @param songTime of the playhead, seconds.
   */
  follow(songTime: number, playing: boolean, loop: LoopSpan | null): void {
    const before = this.#followed;
    this.#followed = { songTime, playing };
    if (before === null) return;
    const jumps = Math.abs(songTime - before.songTime) > JUMP_S;
    const loops = holds(loop, before.songTime) && holds(loop, songTime);
    const begins = playing && !before.playing;
    if (begins || this.#sees(before.songTime) || (jumps && !loops)) this.reveal(songTime);
  }

  get #margin(): number {
    return this.#tight ? 0 : MARGIN;
  }

  #sees(songTime: number): boolean {
    const x = this.xOf(songTime);
    return x >= 0 && x <= this.width;
  }

  /** Pixels a second where the piece fills the place. */
  #whole(): number {
    const scale = Math.max(this.width - 2 * this.#margin, 1) / Math.max(this.duration, 1e-3);
    return Math.min(this.#tight ? scale : Math.max(scale, this.#least()), CLOSEST);
  }

  #least(): number {
    if (this.#tight) return Math.max(this.width, 1) / Math.max(this.duration, 1e-3);
    return Math.max(FURTHEST, Math.min((this.width - 2 * MARGIN) / Math.max(this.duration, 1), 60) * 0.5);
  }

  #bounded(from: number): number {
    const margin = this.#margin / this.scale;
    const span = this.width / this.scale;
    const last = this.#tight ? this.duration - span : this.duration + margin - span * 0.5;
    return Math.max(Math.min(from, Math.max(last, -margin)), -margin);
  }
}

function holds(loop: LoopSpan | null, songTime: number): boolean {
  return loop !== null && songTime >= loop.start && songTime <= loop.end;
}
