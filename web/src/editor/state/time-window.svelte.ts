/** Pixels that a second takes, at most and at least. */
const CLOSEST = 4000;
const FURTHEST = 0.5;
/** Room before the first second, pixels. */
const MARGIN = 12;

/** The span of song time that is on screen. */
export class TimeWindow {
  /** Song time at the left edge, seconds. */
  from = $state(0);
  /** Pixels a second. */
  scale = $state(60);
  width = $state(0);
  /** Seconds that there are to see. */
  duration = $state(1);

  /** Song time at the right edge, seconds. */
  get to(): number {
    return this.from + this.width / this.scale;
  }

  xOf(songTime: number): number {
    return (songTime - this.from) * this.scale;
  }

  timeAt(x: number): number {
    return this.from + x / this.scale;
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
    const room = Math.max(this.width - 2 * MARGIN, 1);
    this.scale = Math.min(Math.max(room / Math.max(end - start, 1e-3), this.#least()), CLOSEST);
    this.from = this.#bounded((start + end) / 2 - this.width / this.scale / 2);
  }

  showAll(): void {
    this.show(0, this.duration);
  }

  /** Bring a time into view where it is not. */
  reveal(songTime: number): void {
    const x = this.xOf(songTime);
    if (x < 0 || x > this.width) this.from = this.#bounded(songTime - (this.width / this.scale) * 0.1);
  }

  #least(): number {
    return Math.max(FURTHEST, Math.min((this.width - 2 * MARGIN) / Math.max(this.duration, 1), 60) * 0.5);
  }

  #bounded(from: number): number {
    const margin = MARGIN / this.scale;
    const span = this.width / this.scale;
    return Math.max(Math.min(from, Math.max(this.duration + margin - span * 0.5, -margin)), -margin);
  }
}
