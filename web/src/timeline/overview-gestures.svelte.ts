import type { SessionView } from "../state/session-view.svelte";
import { LoopDrag } from "./loop-drag";
import { LoopGrid, type LoopPart, type LoopSpan } from "./loop-span";
import type { TimeWindow } from "./time-window.svelte";
import { buzz, LONG_PRESS_MS, Touches } from "./touches";

/** A pointer's event, with its place on the timeline, pixels. */
export interface OverviewPress {
  readonly x: number;
  readonly y: number;
  readonly id: number;
  readonly touch: boolean;
  readonly shift: boolean;
  readonly alt: boolean;
}

interface HeldLoop {
  readonly kind: "loop";
  readonly drag: LoopDrag;
  readonly begin: OverviewPress;
  moved: boolean;
  /** What it would be; null until the pointer draws it. */
  drawn: LoopSpan | null;
}

type Held =
  { readonly kind: "seek"; readonly begin: OverviewPress; moved: boolean } | HeldLoop | { readonly kind: "scroll" };

/** Seeks sent while the pointer drags, at most one in so many milliseconds. */
const DRAG_PAUSE_MS = 120;
/** From here on a press is a drag, pixels. */
const DRAG = 4;
const DRAG_TOUCH = 8;
/** This near to an edge, a drag moves a zoomed timeline on, pixels. */
const EDGE = 14;

/** What pointers do on the transport's timeline: seek, loop, scroll and zoom. */
export class OverviewGestures {
  readonly #view: () => SessionView;
  readonly #window: TimeWindow;
  readonly #touches = new Touches();
  #held: Held | null = null;
  #longPress: ReturnType<typeof setTimeout> | undefined;
  #sentAt = 0;
  /** Where a seek's pointer is, song time, seconds. */
  sought = $state<number | null>(null);
  /** The loop as it would be if the pointer let go. */
  loop = $state.raw<LoopSpan | null>(null);

  constructor(view: () => SessionView, window: TimeWindow) {
    this.#view = view;
    this.#window = window;
  }

  get busy(): boolean {
    return this.#held !== null || this.#touches.count > 1;
  }

  get grid(): LoopGrid {
    const view = this.#view();
    return new LoopGrid(view.score.bar_lines_s, view.duration);
  }

  /** @param part of the loop that is pressed; null for the rest of the timeline. */
  down(press: OverviewPress, part: LoopPart | null): void {
    if (press.touch) {
      this.#touches.down(press.id, press.x, press.y);
      if (this.#touches.count > 1) {
        this.cancel();
        return;
      }
    }
    if (!this.#view().canControl) return;
    if (part !== null || press.shift) {
      this.#begin(press, part ?? "new");
      return;
    }
    this.#held = { kind: "seek", begin: press, moved: false };
    this.#seek(press.x, true);
    if (!press.touch) return;
    this.#longPress = setTimeout(() => {
      buzz();
      this.sought = null;
      this.#draw(this.#begin(press, "new"), this.grid.bar(this.#timeAt(press.x)));
    }, LONG_PRESS_MS);
  }

  /** Take the bar that says which stretch of the piece is shown. */
  scroll(press: OverviewPress): void {
    this.#held = { kind: "scroll" };
    this.move(press);
  }

  move(press: OverviewPress): void {
    if (press.touch) {
      const pinch = this.#touches.move(press.id, press.x, press.y);
      if (pinch !== null) {
        this.#window.zoom(pinch.factor, pinch.x);
        this.#window.pan(-pinch.dx);
        return;
      }
    }
    const held = this.#held;
    if (held === null) return;
    if (held.kind === "scroll") {
      const { duration, width, from, to } = this.#window;
      this.#window.pan(((press.x / width) * duration - (from + to) / 2) * this.#window.scale);
      return;
    }
    const far = press.touch ? DRAG_TOUCH : DRAG;
    held.moved ||= Math.hypot(press.x - held.begin.x, press.y - held.begin.y) >= far;
    if (!held.moved) return;
    clearTimeout(this.#longPress);
    this.#moveOn(press.x);
    if (held.kind === "seek") this.#seek(press.x, false);
    else this.#draw(held, held.drag.at(this.#timeAt(press.x), press.alt));
  }

  /** @param tapped what a press does that has not moved; without it, go there. */
  async up(press: OverviewPress, tapped?: () => void): Promise<void> {
    clearTimeout(this.#longPress);
    if (press.touch) this.#touches.up(press.id);
    const held = this.#held;
    this.#held = null;
    if (held === null || held.kind === "scroll") return;
    const view = this.#view();
    if (held.kind === "seek") {
      if (this.sought !== null) await view.seek(this.sought);
      this.sought = null;
    } else if (held.drawn !== null) {
      // It stays in sight until the server has it.
      await view.setLoop(held.drawn);
      if (this.loop === held.drawn) this.loop = null;
    } else if (tapped !== undefined) {
      this.loop = null;
      tapped();
    } else await view.seek(this.#timeAt(press.x));
  }

  /** Let go and change nothing; returns whether there was anything. */
  cancel(): boolean {
    clearTimeout(this.#longPress);
    const was = this.#held !== null;
    this.#held = null;
    this.sought = this.loop = null;
    return was;
  }

  /** A pointer is gone without having let go. */
  lost(press: OverviewPress): void {
    this.#touches.up(press.id);
    this.cancel();
  }

  #begin(press: OverviewPress, part: LoopPart): HeldLoop {
    const { loop } = this.#view().transport;
    const there = this.loop ?? (loop === null ? null : { start: loop.start_s, end: loop.end_s });
    const drag = new LoopDrag(this.grid, part, this.#timeAt(press.x), part === "new" ? null : there);
    const held: HeldLoop = { kind: "loop", drag, begin: press, moved: false, drawn: null };
    this.#held = held;
    return held;
  }

  #draw(held: HeldLoop, loop: LoopSpan): void {
    this.loop = held.drawn = loop;
  }

  #seek(x: number, now: boolean): void {
    this.sought = this.#timeAt(x);
    if (!now && performance.now() - this.#sentAt < DRAG_PAUSE_MS) return;
    this.#sentAt = performance.now();
    void this.#view().seek(this.sought);
  }

  #moveOn(x: number): void {
    if (this.#window.showsAll) return;
    if (x < EDGE) this.#window.pan(-6);
    else if (x > this.#window.width - EDGE) this.#window.pan(6);
  }

  #timeAt(x: number): number {
    return Math.min(Math.max(this.#window.timeAt(x), 0), this.#view().duration);
  }
}
