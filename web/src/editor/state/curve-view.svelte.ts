import type { ShowParameter } from "../../generated/protocol";
import { componentsOf, hasCurve } from "./component-values";
import type { SampledCurve } from "./curves.svelte";
import type { Editor } from "./editor.svelte";
import { FollowedCurves } from "./followed-curves.svelte";
import type { ShowTrack } from "./show-document";
import { valueSpans, type ValueSpan } from "./value-scales";

/** A track whose curve is drawn, with the span of values that its room shows. */
export interface CurvedTrack {
  readonly track: ShowTrack;
  readonly parameter: ShowParameter;
  readonly curve: SampledCurve | null;
  readonly low: number;
  readonly high: number;
  readonly active: boolean;
  /** How many are drawn over it: 0 for the one that is looked at. */
  readonly place: number;
}

const MAX_TRACKS = 8;
/** A preview while a handle is held, at most one in so many milliseconds. */
const PREVIEW_MS = 60;
const POINTS_PER_PIXEL = 0.75;

/** The curves of the chosen tracks, as the server samples them. */
export class CurveView {
  readonly #editor: Editor;
  readonly #curves: FollowedCurves;
  #preview = $state.raw<{ readonly path: string; readonly curve: SampledCurve } | null>(null);
  #previewing = false;
  #previewWanted: ShowTrack | null = null;
  /** While something is held, values keep their place on screen. */
  #frozen = $state.raw<ReadonlyMap<string, readonly [number, number]> | null>(null);

  constructor(editor: Editor) {
    this.#editor = editor;
    this.#curves = new FollowedCurves(editor, POINTS_PER_PIXEL);
  }

  /** The track that is looked at, and those that chosen keyframes stand on. */
  readonly #shown = $derived.by(() => {
    const { active, selection, store } = this.#editor;
    const paths = new Set([...selection.byTrack.keys(), ...(active === null ? [] : [active])]);
    const tracks = (store.document?.tracks ?? []).filter(({ parameter }) => paths.has(parameter));
    const shown = tracks.flatMap((track) => {
      const parameter = this.#editor.parameter(track.parameter);
      return hasCurve(parameter) ? [{ track, parameter, active: track.parameter === active }] : [];
    });
    return shown.sort((a, b) => Number(a.active) - Number(b.active)).slice(-MAX_TRACKS);
  });

  /** The one that is looked at comes last. */
  readonly tracks: readonly CurvedTrack[] = $derived.by(() => {
    const curves = this.#shown.map((shown) => {
      const path = shown.track.parameter;
      const held = this.#preview?.path === path ? this.#preview.curve : null;
      const curve = held ?? this.#curves.sampled.get(path) ?? null;
      return { ...shown, curve, values: valuesOf(shown.track, shown.parameter, curve) };
    });
    const spans = valueSpans(curves, this.#editor.normalised);
    return curves.map(({ track, parameter, active, curve }, index) => {
      const [low, high] = this.#frozen?.get(track.parameter) ?? spans[index] ?? [0, 1];
      return { track, parameter, active, curve, low, high, place: curves.length - 1 - index };
    });
  });

  /** Whether what is drawn is the show as the server has it. */
  get settled(): boolean {
    return this.#curves.settled;
  }

  /** Ask for what is on screen; returns what calls that off. */
  follow(): () => void {
    const paths = this.#shown.map(({ track }) => track.parameter);
    return this.#curves.follow(paths, () => {
      if (this.#frozen === null) this.#preview = null;
    });
  }

  hold(): void {
    this.#frozen = new Map(this.tracks.map(({ track, low, high }) => [track.parameter, [low, high] as const]));
  }

  /** Let go; what was previewed stays until the show's own curve has come. */
  release(keep: boolean): void {
    this.#frozen = null;
    this.#previewWanted = null;
    if (!keep) this.#preview = null;
  }

  /** Show a track's curve as it would be. */
  preview(track: ShowTrack): void {
    this.#previewWanted = track;
    if (!this.#previewing) void this.#readPreviews();
  }

  async #readPreviews(): Promise<void> {
    const { window, curves } = this.#editor;
    this.#previewing = true;
    try {
      for (let track = this.#previewWanted; track !== null; track = this.#previewWanted) {
        this.#previewWanted = null;
        const curve = await curves.preview(track, window.from, window.to, window.width * POINTS_PER_PIXEL);
        if (curve !== null && this.#frozen !== null) this.#preview = { path: track.parameter, curve };
        await new Promise((resolve) => setTimeout(resolve, PREVIEW_MS));
      }
    } catch {
      // The pointer may hold a place that no show can have; the edit itself will say so.
    } finally {
      this.#previewing = false;
    }
  }
}

/** The lowest and highest of a track's values. */
function valuesOf(track: ShowTrack, parameter: ShowParameter, curve: SampledCurve | null): ValueSpan | null {
  let [low, high] = [Infinity, -Infinity];
  const take = (value: number): void => {
    low = Math.min(low, value);
    high = Math.max(high, value);
  };
  for (const { value } of track.keyframes) componentsOf(parameter, value).forEach(take);
  for (const values of curve?.values ?? []) values.forEach(take);
  return low > high ? null : [low, high];
}
