import type { SessionView } from "../../state/session-view.svelte";

/** Seeks sent while the pointer drags, at most one in so many milliseconds. */
const PAUSE_MS = 90;

/** Follows a pointer along the ruler: the player goes there, and what lies there is heard for a moment. */
export class Seeking {
  readonly #view: SessionView;
  #sentAt = -Infinity;
  #wanted: number | null = null;

  constructor(view: SessionView) {
    this.#view = view;
  }

  to(songTime: number): void {
    this.#wanted = songTime;
    if (performance.now() - this.#sentAt < PAUSE_MS) return;
    this.#send();
  }

  end(): void {
    if (this.#wanted !== null) this.#send();
  }

  #send(): void {
    if (this.#wanted === null) return;
    this.#sentAt = performance.now();
    this.#view.scrub(this.#wanted);
    void this.#view.seek(this.#wanted);
    this.#wanted = null;
  }
}
