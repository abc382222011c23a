import type { SampledCurve } from "./curves.svelte";
import type { Editor } from "./editor.svelte";

/** After a change of what is on screen, curves are asked for this much later. */
const PATIENCE_MS = 70;

/** Curves of some parameters over the span on screen, asked of the server anew whenever either changes. */
export class FollowedCurves {
  readonly #editor: Editor;
  readonly #pointsPerPixel: number;
  sampled = $state.raw<ReadonlyMap<string, SampledCurve>>(new Map());
  /** What was read last is the show as the server has it. */
  settled = false;

  constructor(editor: Editor, pointsPerPixel: number) {
    this.#editor = editor;
    this.#pointsPerPixel = pointsPerPixel;
  }

  /** Ask for what is on screen, with half as much again around it; returns what calls that off. For an effect. */
  follow(paths: readonly string[], then: () => void = () => undefined): () => void {
    const { window, curves, reina, store } = this.#editor;
    const [from, to, points] = [window.from, window.to, window.width * this.#pointsPerPixel];
    this.settled = false;
    // What waits to be saved is not yet in the server's curves.
    if (paths.length === 0 || points <= 0 || store.waiting > 0 || store.document === null) return () => undefined;
    const ended = new AbortController();
    const spare = (to - from) / 4;
    const timer = setTimeout(() => {
      curves.read({ paths, from: from - spare, to: to + spare, points: points * 1.5 }, ended.signal).then(
        (read) => {
          this.sampled = read;
          this.settled = true;
          then();
        },
        (error: unknown) => {
          if (!ended.signal.aborted) reina.tell(error);
        },
      );
    }, PATIENCE_MS);
    return () => {
      clearTimeout(timer);
      ended.abort();
    };
  }
}
