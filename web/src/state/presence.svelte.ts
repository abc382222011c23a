const REST_MS = 2600;

/**
 * Whether the panels are there. They leave when the pointer rests, but never while something under them is wanted:
 * the pointer is on one, the keyboard is in one, or `held` says that something is going on.
 */
export class Presence {
  shown = $state(true);
  readonly #held: () => boolean;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** @param held asked when the pointer has rested long enough; true keeps the panels */
  constructor(held: () => boolean) {
    this.#held = held;
    this.stir();
  }

  /** Something moved: the panels come back and stay a while. */
  stir(): void {
    this.shown = true;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#rest(), REST_MS);
  }

  stop(): void {
    clearTimeout(this.#timer);
  }

  #rest(): void {
    if (this.#held()) this.stir();
    else this.shown = false;
  }
}
