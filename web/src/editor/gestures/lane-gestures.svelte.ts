import { retime } from "../commands/keys";
import { moveMarker } from "../commands/markers";
import { headHeight, type Layout } from "../canvas/layout";
import { LoopDrag } from "../../timeline/loop-drag";
import type { LoopPart, LoopSpan } from "../../timeline/loop-span";
import type { Editor } from "../state/editor.svelte";
import { keysInShot } from "../state/shots";
import { movedBy, stretched, type Retiming, type Span } from "../state/spans";
import { hitAt, keysInBox, type Hit, type KeyName } from "./hit";
import { Seeking } from "./seeking";
import { buzz, LONG_PRESS_MS, Touches } from "../../timeline/touches";
import { does } from "../../words/editor-does/en";

/** A pointer's event, with its place in the timeline, pixels. */
export interface Press {
  readonly x: number;
  readonly y: number;
  readonly id: number;
  readonly touch: boolean;
  readonly button: number;
  readonly adds: boolean;
  readonly shift: boolean;
  readonly alt: boolean;
}

export interface Box {
  readonly x0: number;
  readonly y0: number;
  readonly x1: number;
  readonly y1: number;
}

type Gesture =
  | { readonly kind: "seek"; readonly seeking: Seeking }
  | {
      readonly kind: "keys";
      readonly anchor: number;
      readonly begin: Press;
      readonly alone: readonly KeyName[] | null;
      /** Song times, seconds, that the anchor stays between. */
      readonly within?: Span;
      moved: boolean;
    }
  | { readonly kind: "stretch"; readonly held: number; readonly from: number }
  | { readonly kind: "loop"; readonly drag: LoopDrag; readonly begin: Press; moved: boolean }
  | { readonly kind: "marker"; readonly index: number; readonly begin: Press; moved: boolean }
  | {
      readonly kind: "box";
      readonly begin: Press;
      readonly from: number;
      readonly top: number;
      readonly hit: Hit;
      moved: boolean;
    }
  | { readonly kind: "pan"; readonly begin: Press; readonly hit: Hit | null; last: Press; moved: boolean };

/** From here on a press is a drag, pixels. */
const DRAG = 3;
const DRAG_TOUCH = 8;
const FINGER = 22;
/** What a neighbour of a shot that is moved keeps, seconds. */
const SHORTEST_SHOT_S = 0.25;
/** This near to an edge, a drag moves the window on, pixels. */
const EDGE = 18;
const REACH = 8;
const REACH_TOUCH = 18;

/** What pointers do on the timeline: seek, choose, move, stretch, pan and zoom. */
export class LaneGestures {
  readonly #editor: Editor;
  readonly #layout: () => Layout;
  readonly #touches = new Touches();
  #gesture: Gesture | null = null;
  #longPress: ReturnType<typeof setTimeout> | undefined;
  #pressed: Press | null = null;
  /** A finger has rested so long that, let go where it is, it asks for the menu. */
  rested = $state(false);
  box = $state.raw<Box | null>(null);
  /** The loop as it would be if the pointer let go, song time, seconds. */
  loop = $state.raw<LoopSpan | null>(null);
  /** Where a marker is while the pointer holds it, song time, seconds. */
  heldMarker = $state.raw<{ readonly index: number; readonly time: number } | null>(null);

  constructor(editor: Editor, layout: () => Layout) {
    this.#editor = editor;
    this.#layout = layout;
  }

  get busy(): boolean {
    return this.#gesture !== null;
  }

  hit(press: Press): Hit {
    return hitAt(this.#editor, this.#layout(), press.x, press.y, press.touch ? REACH_TOUCH : REACH);
  }

  down(press: Press): void {
    if (press.touch) {
      this.#touches.down(press.id, press.x, press.y);
      if (this.#touches.count > 1) {
        this.cancel();
        return;
      }
    }
    if (press.button === 1) this.#gesture = { kind: "pan", begin: press, hit: null, last: press, moved: false };
    if (press.button !== 0) return;
    const hit = this.hit(press);
    this.#gesture = this.#begin(press, hit);
    this.rested = false;
    this.#pressed = press;
    if (press.touch) {
      this.#longPress = setTimeout(() => {
        buzz();
        this.rested = true;
        if (this.#gesture?.kind !== "pan") return;
        this.#gesture = this.#beginBox(press, hit);
        // A box around the finger says that it has begun.
        this.box = { x0: press.x - FINGER, y0: press.y - FINGER, x1: press.x + FINGER, y1: press.y + FINGER };
      }, LONG_PRESS_MS);
    }
  }

  move(press: Press): void {
    if (press.touch) {
      const pinch = this.#touches.move(press.id, press.x, press.y);
      if (pinch !== null) {
        this.#editor.window.zoom(pinch.factor, pinch.x);
        this.#editor.window.pan(-pinch.dx);
        this.#scroll(-pinch.dy);
        return;
      }
    }
    const begin = this.#pressed;
    if (begin !== null && Math.hypot(press.x - begin.x, press.y - begin.y) >= DRAG_TOUCH) {
      clearTimeout(this.#longPress);
      this.rested = false;
    }
    const gesture = this.#gesture;
    if (gesture === null) return;
    const { window } = this.#editor;
    switch (gesture.kind) {
      case "seek":
        gesture.seeking.to(this.#editor.snap(window.timeAt(press.x), press.alt, 5));
        break;
      case "keys":
        if (this.#hasMoved(gesture, press) && this.#editor.editable) this.#moveKeys(gesture, press);
        break;
      case "stretch":
        this.#editor.moving = this.#stretching(gesture, press);
        break;
      case "loop":
        if (!this.#hasMoved(gesture, press)) break;
        this.#panAtEdges(press);
        this.loop = gesture.drag.at(window.timeAt(press.x), press.alt);
        break;
      case "marker":
        if (this.#hasMoved(gesture, press) && this.#editor.editable) {
          this.heldMarker = {
            index: gesture.index,
            time: this.#editor.snap(Math.max(window.timeAt(press.x), 0), press.alt),
          };
        }
        break;
      case "box":
        if (this.#hasMoved(gesture, press)) this.#drawBox(gesture, press);
        break;
      case "pan":
        if (!this.#hasMoved(gesture, press)) break;
        window.pan(gesture.last.x - press.x);
        this.#scroll(gesture.last.y - press.y);
        gesture.last = press;
        break;
    }
  }

  /** The pointer lets go; returns whether it asks for the menu, as a finger does that has rested. */
  up(press: Press): boolean {
    clearTimeout(this.#longPress);
    if (press.touch) this.#touches.up(press.id);
    const gesture = this.#gesture;
    const rested = this.rested;
    this.rested = false;
    if (rested && gesture !== null) {
      this.cancel();
      return true;
    }
    this.#gesture = null;
    if (gesture !== null) this.#end(gesture, press);
    return false;
  }

  #end(gesture: Gesture, press: Press): void {
    switch (gesture.kind) {
      case "seek":
        gesture.seeking.end();
        break;
      case "keys":
        if (gesture.moved) this.#place(does.keyMoved);
        else if (gesture.alone !== null) this.#editor.selection.set(gesture.alone);
        break;
      case "stretch":
        this.#place(does.keyStretched);
        break;
      case "loop":
        void this.#placeLoop(gesture, press);
        break;
      case "marker":
        if (this.heldMarker !== null) moveMarker(this.#editor, gesture.index, this.heldMarker.time);
        else if (this.#editor.view.canControl)
          void this.#editor.view.seek(this.#editor.markerTimes[gesture.index] ?? 0);
        this.heldMarker = null;
        break;
      case "box":
        this.#chooseBox(gesture, press);
        break;
      case "pan":
        if (!gesture.moved && gesture.hit?.kind === "row") this.#tapRow(gesture.hit, press);
        break;
    }
  }

  /** Let go of everything and leave the show as it is; returns whether there was anything. */
  cancel(): boolean {
    clearTimeout(this.#longPress);
    const was = this.#gesture !== null;
    this.#gesture = null;
    this.#editor.moving = null;
    this.box = null;
    this.heldMarker = this.loop = null;
    return was;
  }

  /** The wheel: along the time with Shift or sideways, up and down the rows; with Ctrl, or by a pinch, it zooms. */
  wheel(
    event: { deltaX: number; deltaY: number; ctrlKey: boolean; metaKey: boolean; shiftKey: boolean },
    x: number,
    y: number,
  ): void {
    const { window } = this.#editor;
    if (event.ctrlKey || event.metaKey) {
      window.zoom(Math.exp(-event.deltaY * 0.004), x);
      return;
    }
    const alongTime = event.shiftKey || y < headHeight(this.#layout());
    if (event.deltaX !== 0) window.pan(event.deltaX);
    if (alongTime) window.pan(event.deltaY);
    else this.#scroll(event.deltaY);
  }

  #begin(press: Press, hit: Hit): Gesture | null {
    const editor = this.#editor;
    const { window, span } = editor;
    switch (hit.kind) {
      case "loop":
        return this.#beginLoop(press, hit.part);
      case "ruler": {
        if (!editor.view.canControl) return null;
        if (press.shift) return this.#beginLoop(press, "new");
        const seeking = new Seeking(editor.view);
        seeking.to(editor.snap(Math.max(window.timeAt(press.x), 0), press.alt, 5));
        return { kind: "seek", seeking };
      }
      case "marker":
        editor.marker = hit.index;
        return { kind: "marker", index: hit.index, begin: press, moved: false };
      case "grip":
        if (span === null || !editor.editable) return null;
        return hit.side === "end"
          ? { kind: "stretch", held: span.start, from: span.end }
          : { kind: "stretch", held: span.end, from: span.start };
      case "span":
        return { kind: "keys", anchor: span?.start ?? 0, begin: press, alone: null, moved: false };
      case "key":
        return this.#beginKeys(press, hit);
      case "shot":
        return this.#beginShot(press, hit.index);
      case "row":
        if (press.touch) return { kind: "pan", begin: press, hit, last: press, moved: false };
        return this.#beginBox(press, hit);
    }
  }

  #beginLoop(press: Press, part: LoopPart): Gesture | null {
    const { view, loopGrid, loop, window } = this.#editor;
    if (!view.canControl) return null;
    const drag = new LoopDrag(loopGrid, part, window.timeAt(press.x), part === "new" ? null : (this.loop ?? loop));
    return { kind: "loop", drag, begin: press, moved: false };
  }

  /** What was drawn becomes the loop; a click ends the loop that it meets, and goes there elsewhere. */
  async #placeLoop({ drag, moved }: Gesture & { kind: "loop" }, press: Press): Promise<void> {
    const { view, window } = this.#editor;
    const { loop } = this;
    // What was drawn before stays in sight until the server has it, and is no answer to a click.
    if (moved && loop !== null) {
      await view.setLoop(loop);
      if (this.loop === loop) this.loop = null;
    } else if (drag.part === "whole") {
      this.loop = null;
      await view.setLoop(null);
    } else await view.seek(Math.max(window.timeAt(press.x), 0));
  }

  #beginKeys(press: Press, hit: Hit & { kind: "key" }): Gesture | null {
    const { selection } = this.#editor;
    const all = hit.keys.every(([path, key]) => selection.has(path, key));
    if (hit.row.kind === "track") this.#editor.look(hit.row.track.parameter);
    if (press.adds) {
      selection.toggle(hit.keys);
      return null;
    }
    if (!all) selection.set(hit.keys);
    return { kind: "keys", anchor: hit.time, begin: press, alone: all ? hit.keys : null, moved: false };
  }

  /** A shot moves between its neighbours, which become longer and shorter for it. */
  #beginShot(press: Press, index: number): Gesture | null {
    const { selection, shots, store, times } = this.#editor;
    const shot = shots[index];
    if (shot === undefined) return null;
    const keys = keysInShot(store.document?.tracks ?? [], (track) => times.of(track), shot);
    if (press.adds) {
      selection.toggle(keys);
      return null;
    }
    selection.set(keys);
    this.#editor.said = does.shotChosen({ number: index + 1, all: shots.length });
    const before = shots[index - 1];
    const room = (shots[index + 1]?.end ?? Infinity) - shot.end;
    const within = {
      start: before === undefined ? 0 : Math.min(before.start + SHORTEST_SHOT_S, shot.start),
      end: shot.start + Math.max(room - SHORTEST_SHOT_S, 0),
    };
    return { kind: "keys", anchor: shot.start, begin: press, alone: null, within, moved: false };
  }

  #beginBox(press: Press, hit: Hit): Gesture {
    const top = press.y - headHeight(this.#layout()) + this.#editor.scrollTop;
    return { kind: "box", begin: press, from: this.#editor.window.timeAt(press.x), top, hit, moved: false };
  }

  #hasMoved(gesture: { readonly begin: Press; moved: boolean }, press: Press): boolean {
    const far = press.touch ? DRAG_TOUCH : DRAG;
    gesture.moved ||= Math.hypot(press.x - gesture.begin.x, press.y - gesture.begin.y) >= far;
    return gesture.moved;
  }

  #moveKeys({ anchor, begin, within }: Gesture & { kind: "keys" }, press: Press): void {
    const editor = this.#editor;
    const { window, axis, span } = editor;
    this.#panAtEdges(press);
    const wanted = anchor + (press.x - begin.x) / window.scale;
    // Nothing stands before the music begins.
    const least = Math.max(anchor - (span?.start ?? 0) + editor.lead, within?.start ?? 0);
    const to = Math.min(Math.max(editor.snap(wanted, press.alt), least), within?.end ?? Infinity);
    editor.moving = movedBy(axis, anchor, to);
  }

  #panAtEdges(press: Press): void {
    const { window } = this.#editor;
    if (press.x < EDGE) window.pan(-6);
    else if (press.x > window.width - EDGE) window.pan(6);
  }

  #stretching(gesture: Gesture & { kind: "stretch" }, press: Press): Retiming {
    const { window, axis } = this.#editor;
    const to = this.#editor.snap(Math.max(window.timeAt(press.x), 0), press.alt);
    return stretched(axis, gesture.held, gesture.from, to);
  }

  #place(says: (made: { count: number }) => string): void {
    const { moving } = this.#editor;
    this.#editor.moving = null;
    if (moving !== null) retime(this.#editor, says({ count: this.#editor.chosen.length }), moving);
  }

  #drawBox(gesture: Gesture & { kind: "box" }, press: Press): void {
    const { window, scrollTop } = this.#editor;
    const head = headHeight(this.#layout());
    if (press.y > this.#bottom - EDGE) this.#scroll(8);
    else if (press.y < head + EDGE) this.#scroll(-8);
    this.box = {
      x0: window.xOf(gesture.from),
      y0: gesture.top + head - scrollTop,
      x1: press.x,
      y1: Math.max(press.y, head),
    };
  }

  #chooseBox(gesture: Gesture & { kind: "box" }, press: Press): void {
    this.box = null;
    if (!gesture.moved) {
      if (gesture.hit.kind === "row") this.#tapRow(gesture.hit, press);
      return;
    }
    const { window, selection, scrollTop, mode } = this.#editor;
    if (mode === "curves") return;
    const times = [gesture.from, window.timeAt(press.x)];
    const heights = [gesture.top, press.y - headHeight(this.#layout()) + scrollTop];
    const keys = keysInBox(this.#editor, this.#layout(), {
      from: Math.min(...times),
      to: Math.max(...times),
      top: Math.min(...heights),
      bottom: Math.max(...heights),
    });
    if (press.adds) selection.add(keys);
    else selection.set(keys);
    this.#editor.said = does.chosen({ count: selection.size });
  }

  #tapRow({ row }: Hit & { kind: "row" }, press: Press): void {
    if (!press.adds) this.#editor.selection.clear();
    if (this.#editor.mode === "curves") return;
    if (row?.kind === "track") this.#editor.look(row.track.parameter);
    else this.#editor.marker = null;
  }

  /** Height of the whole timeline, pixels; set by what draws it. */
  #bottom = 0;

  set height(pixels: number) {
    this.#bottom = pixels;
  }

  #scroll(pixels: number): void {
    const room = this.#bottom - headHeight(this.#layout());
    const most = Math.max(this.#editor.rows.length * this.#layout().row - room, 0);
    this.#editor.scrollTop = Math.min(Math.max(this.#editor.scrollTop + pixels, 0), most);
  }
}
