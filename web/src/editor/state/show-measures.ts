import type { Editor } from "./editor.svelte";

/** A point in the window, pixels. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Where the timeline has drawn things. */
export interface TimelinePlaces {
  /** A keyframe's mark; on curves that of one of its value's components. */
  key(path: string, key: string, component: number): Point | null;
  /** The middle of a shot's block in the camera's row. */
  shot(index: number): Point | null;
  /** The ruler at a song time, seconds. */
  time(songTime: number): Point;
  /** The strip along which loops are drawn, at a song time, seconds. */
  loop(songTime: number): Point;
  /** The bar over the chosen keyframes: its two grips. */
  grips(): readonly [Point, Point] | null;
  /** Whether the curves on screen are those of the show as the server has it. */
  curvesSettled(): boolean;
  /** Handles of the curve that is looked at. */
  handles(): readonly Point[];
}

/** What the show's editor says about itself, for tests and for whoever opens the console: `window.reina.show`. */
export interface ShowMeasures extends TimelinePlaces {
  readonly saving: string;
  readonly waiting: number;
  readonly undoSteps: number;
  readonly redoSteps: number;
  readonly mode: string;
  readonly active: string | null;
  /** Path and key of each chosen keyframe. */
  readonly chosen: readonly (readonly [string, string])[];
  /** How many keyframes the page shows in all. */
  readonly keyframes: number;
  /** Song time of the loop's ends; nothing without one. */
  readonly looped: readonly number[];
  /** Song time at the left edge and at the right one. */
  readonly window: readonly [number, number];
}

/** Put the figures on the window's; returns what takes them away again. */
export function publishShow(editor: Editor, places: TimelinePlaces): () => void {
  const { store, selection, window: span } = editor;
  const show: ShowMeasures = {
    ...places,
    get saving() {
      return store.saving;
    },
    get waiting() {
      return store.waiting;
    },
    get undoSteps() {
      return store.undoSteps;
    },
    get redoSteps() {
      return store.redoSteps;
    },
    get mode() {
      return editor.mode;
    },
    get active() {
      return editor.active;
    },
    get chosen() {
      return [...selection.byTrack].flatMap(([path, keys]) => [...keys].map((key) => [path, key] as const));
    },
    get keyframes() {
      return (store.document?.tracks ?? []).reduce((sum, { keyframes }) => sum + keyframes.length, 0);
    },
    get looped() {
      return editor.loop === null ? [] : [editor.loop.start, editor.loop.end];
    },
    get window() {
      return [span.from, span.to] as const;
    },
  };
  if (window.reina !== undefined) window.reina.show = show;
  return () => {
    if (window.reina?.show === show) delete window.reina.show;
  };
}
