/** A small picture of valves or feet over the stage, from a camera of its own. */

import { PerspectiveCamera, Vector2, type Scene, type WebGLRenderer } from "three";

import type { FramedView } from "./camera-presets";
import { OUTLINE_LAYER } from "./toon";

/** Its side as a share of the shorter side of the window, and its bounds, CSS pixels. */
const SHARE = 0.3;
const MIN_SIDE = 120;
const MAX_SIDE = 300;

/** Where the small picture lies, CSS pixels from the window's left and top. */
export interface InsetPlace {
  readonly left: number;
  readonly top: number;
  readonly side: number;
}

export class Inset {
  /** Where it lies; null where it is not shown. */
  place: InsetPlace | null = null;
  /** Whose valves or feet it shows, of several: a place in the cast. */
  player = 0;
  readonly #camera = new PerspectiveCamera(20, 1, 0.05, 60);
  readonly #size = new Vector2();

  constructor() {
    this.#camera.layers.enable(OUTLINE_LAYER);
  }

  /** Draw over what is on the canvas, as a view has it; the shadows are those of the large picture. */
  render(renderer: WebGLRenderer, scene: Scene, { position, target, fov }: FramedView): void {
    if (this.place === null) return;
    const camera = this.#camera;
    camera.position.fromArray(position);
    camera.lookAt(...target);
    camera.fov = (fov * 180) / Math.PI;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const { left, top, side } = this.place;
    renderer.getSize(this.#size);
    const bottom = this.#size.y - top - side;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(null);
    renderer.setScissorTest(true);
    renderer.setViewport(left, bottom, side, side);
    renderer.setScissor(left, bottom, side, side);
    renderer.render(scene, camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, this.#size.x, this.#size.y);
    renderer.shadowMap.autoUpdate = true;
  }
}

/** How large the small picture is in a window, CSS pixels. */
export function insetSide(width: number, height: number): number {
  return Math.round(Math.min(Math.max(SHARE * Math.min(width, height), MIN_SIDE), MAX_SIDE));
}
