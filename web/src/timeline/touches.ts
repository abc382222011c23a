/** A finger that rests so long means more than a tap. */
export const LONG_PRESS_MS = 420;

interface Point {
  readonly x: number;
  readonly y: number;
}

/** Two fingers' move: where their middle was, how far it went, and by what factor they are apart. */
export interface Pinch {
  readonly x: number;
  readonly dx: number;
  readonly dy: number;
  readonly factor: number;
}

/** Let a finger feel that its long press is taken, where the device can. */
export function buzz(): void {
  if ("vibrate" in navigator) navigator.vibrate(12);
}

/** Nearer to each other than this, two fingers do not zoom, pixels. */
const MIN_APART = 24;

/** The fingers on the timeline. */
export class Touches {
  readonly #points = new Map<number, Point>();

  get count(): number {
    return this.#points.size;
  }

  down(id: number, x: number, y: number): void {
    this.#points.set(id, { x, y });
  }

  up(id: number): void {
    this.#points.delete(id);
  }

  clear(): void {
    this.#points.clear();
  }

  /** A finger moved; what that means where two are down, else null. */
  move(id: number, x: number, y: number): Pinch | null {
    if (!this.#points.has(id)) return null;
    const before = this.#pair();
    this.#points.set(id, { x, y });
    const after = this.#pair();
    if (before === null || after === null) return null;
    const zooms = before.apart > MIN_APART && after.apart > MIN_APART;
    return {
      x: before.x,
      dx: after.x - before.x,
      dy: after.y - before.y,
      factor: zooms ? after.apart / before.apart : 1,
    };
  }

  #pair(): { x: number; y: number; apart: number } | null {
    const [one, other] = [...this.#points.values()];
    if (one === undefined || other === undefined) return null;
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2, apart: Math.abs(one.x - other.x) };
  }
}
