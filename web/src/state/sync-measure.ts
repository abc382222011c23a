const READINGS = 240;

/** How far the picture is ahead of the sound, over the last few seconds of play; nothing is allocated for a reading. */
export class SyncMeasure {
  readonly #readings = new Float64Array(READINGS);
  readonly #intervals = new Float64Array(READINGS);
  #count = 0;

  /**
   * @param difference seconds by which a picture was ahead of the sound when it came to be seen
   * @param interval seconds from when it was drawn until then: how exactly that moment is known
   */
  add(difference: number, interval: number): void {
    this.#readings[this.#count % READINGS] = difference;
    this.#intervals[this.#count % READINGS] = interval;
    this.#count += 1;
  }

  get count(): number {
    return this.#count;
  }

  /** The last readings, the oldest first: difference and interval. */
  get recent(): [difference: number, interval: number][] {
    const kept = Math.min(this.#count, READINGS);
    return Array.from({ length: kept }, (_, place) => {
      const at = (this.#count - kept + place) % READINGS;
      return [this.#readings[at] ?? 0, this.#intervals[at] ?? 0];
    });
  }

  /** The difference that so large a share of the readings stays within (0.95: p95 of |difference|), seconds. */
  within(share: number): number {
    const sizes = this.#readings.slice(0, Math.min(this.#count, READINGS)).map(Math.abs).sort();
    return sizes[Math.min(Math.floor(sizes.length * share), sizes.length - 1)] ?? 0;
  }

  /** The mean difference, seconds; positive when the picture is ahead. */
  get mean(): number {
    const kept = Math.min(this.#count, READINGS);
    return kept === 0 ? 0 : this.#readings.slice(0, kept).reduce((sum, each) => sum + each, 0) / kept;
  }

  reset(): void {
    this.#count = 0;
  }
}
