import type { LoopGrid, LoopPart, LoopSpan } from "./loop-span";

/** A loop in the making, or one of which a part is held: what it would be where the pointer is. */
export class LoopDrag {
  readonly part: LoopPart;
  readonly #grid: LoopGrid;
  readonly #anchor: number;
  readonly #loop: LoopSpan | null;

  /**
   * @param at song time of the press, seconds.
   * @param loop that there is; what of it is taken must be there.
   */
  constructor(grid: LoopGrid, part: LoopPart, at: number, loop: LoopSpan | null) {
    this.#grid = grid;
    this.part = loop === null ? "new" : part;
    this.#loop = loop;
    this.#anchor = at;
  }

  /** @param free whether the bars do not draw it. */
  at(time: number, free: boolean): LoopSpan {
    const loop = this.#loop;
    if (loop === null || this.part === "new") return this.#grid.between(this.#anchor, time, free);
    if (this.part === "whole") return this.#grid.movedTo(loop, loop.start + time - this.#anchor, free);
    return this.#grid.resized(this.part === "start" ? loop.end : loop.start, time, free);
  }
}
