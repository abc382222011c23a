/** A stage of its own for a film, so that the page's goes on: the same scene, drawn as large as is asked. */

import type { Hello } from "../generated/protocol";
import { type ScoreView, Stage, type Tier } from "../scene";
import { film } from "../words/film/en";
import type { FilmFrame } from "./frames";
import type { PictureSize } from "./picture-size";

export interface FilmStageOptions {
  readonly size: PictureSize;
  readonly tier: Tier;
  /** Nothing but the players, on nothing. */
  readonly transparent?: boolean;
}

export class FilmStage {
  readonly canvas: HTMLCanvasElement;
  readonly #stage: Stage;

  /**
   * A stage with a session's players and notes on it.
   *
   * @throws StageUnavailableError where the browser gives no other drawing context.
   * @throws RigError, LayoutError as `Stage.load` does.
   */
  static async open(hello: Hello, score: ScoreView, options: FilmStageOptions): Promise<FilmStage> {
    const made = new FilmStage(options);
    try {
      await made.#stage.load(hello, (rig) => hello.links.rigs[rig] ?? `/api/v1/rigs/${encodeURIComponent(rig)}`);
      made.#stage.setScore(score);
      return made;
    } catch (error) {
      made.dispose();
      throw error;
    }
  }

  private constructor({ size, tier, transparent = false }: FilmStageOptions) {
    this.canvas = document.createElement("canvas");
    // A film is drawn by its frames alone: no view is ever on its way to another here.
    this.#stage = new Stage(this.canvas, { tier, reducedMotion: false, transparent });
    this.#stage.resize(size.width, size.height, 1);
    const { drawingBufferWidth: width = 0, drawingBufferHeight: height = 0 } = this.#context() ?? {};
    if (width !== size.width || height !== size.height) {
      this.dispose();
      const [mostWidth, mostHeight] = [`${width}`, `${height}`];
      throw new Error(film.deviceTooSmall({ mostWidth, mostHeight, width: `${size.width}`, height: `${size.height}` }));
    }
  }

  /** Draw a frame; it is on the canvas until the caller gives control back to the browser. */
  draw(frame: FilmFrame): void {
    this.#stage.draw(frame);
    if (this.#stage.drawnIndex !== frame.index) {
      throw new Error(film.graphicsGaveUp);
    }
  }

  /** Give everything back at once: a page may hold few drawing contexts, and a large picture much memory. */
  dispose(): void {
    this.#stage.dispose();
    this.#context()?.getExtension("WEBGL_lose_context")?.loseContext();
    this.canvas.width = this.canvas.height = 0;
  }

  #context(): WebGL2RenderingContext | null {
    return this.canvas.getContext("webgl2");
  }
}
