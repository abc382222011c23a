/** A small picture of the valves over the stage, from a camera of its own. */

import { PerspectiveCamera, Vector2, type Scene, type WebGLRenderer } from "three";

import { findPreset } from "./camera-presets";
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

export class ValvesInset {
  #shown = false;
  #place: InsetPlace = { left: 0, top: 0, side: MIN_SIDE };
  readonly #camera = new PerspectiveCamera(20, 1, 0.05, 60);
  readonly #size = new Vector2();

  constructor() {
    const preset = findPreset("valves");
    if (preset === null) throw new Error("there is no view of the valves");
    this.#camera.position.fromArray(preset.position);
    this.#camera.lookAt(...preset.target);
    this.#camera.fov = (preset.fov * 180) / Math.PI;
    this.#camera.layers.enable(OUTLINE_LAYER);
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }

  get shown(): boolean {
    return this.#shown;
  }

  show(shown: boolean): void {
    this.#shown = shown;
  }

  /** @param place where it lies; null where it is not seen. */
  setPlace(place: InsetPlace): void {
    this.#place = place;
  }

  /** Draw over what is on the canvas; the shadows are those of the large picture. */
  render(renderer: WebGLRenderer, scene: Scene): void {
    if (!this.#shown) return;
    const { left, top, side } = this.#place;
    renderer.getSize(this.#size);
    const bottom = this.#size.y - top - side;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(null);
    renderer.setScissorTest(true);
    renderer.setViewport(left, bottom, side, side);
    renderer.setScissor(left, bottom, side, side);
    renderer.render(scene, this.#camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, this.#size.x, this.#size.y);
    renderer.shadowMap.autoUpdate = true;
  }
}

/** How large the small picture is in a window, CSS pixels. */
export function insetSide(width: number, height: number): number {
  return Math.round(Math.min(Math.max(SHARE * Math.min(width, height), MIN_SIDE), MAX_SIDE));
}
