/** The finished picture: light of a wide range is gathered first, then it blooms, is focused and toned. */

import {
  AdditiveBlending,
  DepthTexture,
  HalfFloatType,
  LinearFilter,
  type PerspectiveCamera,
  ShaderMaterial,
  UnsignedIntType,
  Vector2,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

import { COMPOSITE_FRAGMENT, DOWN_FRAGMENT, QUAD_VERTEX, UP_FRAGMENT } from "./picture-shaders";
import type { TierSettings } from "./tiers";

/** Pictures of the bloom, each half as large as the one before. */
const LEVELS = 5;
const SAMPLES = 4;

function pass(fragmentShader: string, uniforms: Record<string, { value: unknown }>, added = false): ShaderMaterial {
  return new ShaderMaterial({
    uniforms,
    vertexShader: QUAD_VERTEX,
    fragmentShader,
    depthTest: false,
    depthWrite: false,
    transparent: added,
    // Added to what is there.
    ...(added ? { blending: AdditiveBlending } : {}),
  });
}

export class Picture {
  bloomStrength = 0.35;
  bloomThreshold = 1;
  /** Metres from the camera; 0 is at its target. */
  focusDistance = 0;
  /** Width of the lens's opening, metres. */
  aperture = 0;
  readonly #renderer: WebGLRenderer;
  readonly #gathered: WebGLRenderTarget | null;
  readonly #levels: WebGLRenderTarget[] = [];
  readonly #uniforms = {
    picture: { value: null as unknown },
    texel: { value: new Vector2() },
    threshold: { value: 0 },
    bloomed: { value: null as unknown },
    bloom: { value: 0 },
    depth: { value: null as unknown },
    /** Nearest and farthest that is drawn, metres. */
    range: { value: new Vector2(0.05, 60) },
    focus: { value: 3 },
    /** Width of the blur disc of a point at infinity, as a share of the picture's height. */
    blur: { value: 0 },
    aspect: { value: 1 },
  };
  readonly #down = pass(DOWN_FRAGMENT, this.#uniforms);
  readonly #up = pass(UP_FRAGMENT, this.#uniforms, true);
  readonly #composite = pass(COMPOSITE_FRAGMENT, this.#uniforms);
  readonly #quad = new FullScreenQuad();

  constructor(renderer: WebGLRenderer, tier: TierSettings) {
    this.#renderer = renderer;
    const wide =
      renderer.extensions.has("EXT_color_buffer_float") || renderer.extensions.has("EXT_color_buffer_half_float");
    if (!tier.bloom || !wide) {
      this.#gathered = null;
      return;
    }
    this.#gathered = new WebGLRenderTarget(16, 16, {
      type: HalfFloatType,
      samples: SAMPLES,
      minFilter: LinearFilter,
      magFilter: LinearFilter,
    });
    if (tier.depthOfField) this.#gathered.depthTexture = new DepthTexture(16, 16, UnsignedIntType);
    this.#uniforms.depth.value = this.#gathered.depthTexture;
    this.#composite.defines = tier.depthOfField ? { FOCUS: "" } : {};
    for (let level = 0; level < LEVELS; level++) {
      this.#levels.push(
        new WebGLRenderTarget(16, 16, {
          type: HalfFloatType,
          depthBuffer: false,
          minFilter: LinearFilter,
          magFilter: LinearFilter,
        }),
      );
    }
  }

  /** Where the scene is drawn; null is the canvas. */
  get target(): WebGLRenderTarget | null {
    return this.#gathered;
  }

  /** @param width of the picture, pixels. */
  resize(width: number, height: number): void {
    this.#gathered?.setSize(Math.max(1, Math.round(width)), Math.max(1, Math.round(height)));
    this.#levels.forEach((level, i) => {
      level.setSize(Math.max(1, Math.round(width / 2 ** (i + 1))), Math.max(1, Math.round(height / 2 ** (i + 1))));
    });
  }

  #draw(material: ShaderMaterial, from: WebGLRenderTarget, to: WebGLRenderTarget | null): void {
    const { picture, texel } = this.#uniforms;
    picture.value = from.texture;
    texel.value.set(1 / from.width, 1 / from.height);
    this.#quad.material = material;
    this.#renderer.setRenderTarget(to);
    this.#quad.render(this.#renderer);
  }

  #spill(gathered: WebGLRenderTarget): void {
    const levels = this.#levels;
    const { threshold } = this.#uniforms;
    threshold.value = this.bloomThreshold;
    let from = gathered;
    for (const level of levels) {
      this.#draw(this.#down, from, level);
      from = level;
      threshold.value = -1;
    }
    this.#renderer.autoClear = false;
    for (let i = levels.length - 2; i >= 0; i--) {
      const [smaller, larger] = [levels[i + 1], levels[i]];
      if (smaller !== undefined && larger !== undefined) this.#draw(this.#up, smaller, larger);
    }
    this.#renderer.autoClear = true;
  }

  /** Put what was gathered on the canvas. */
  finish(camera: PerspectiveCamera, targetDistance: number): void {
    const gathered = this.#gathered;
    if (gathered === null) return;
    const uniforms = this.#uniforms;
    const blooms = this.bloomStrength > 0;
    if (blooms) this.#spill(gathered);
    uniforms.bloomed.value = this.#levels[0]?.texture ?? null;
    uniforms.bloom.value = blooms ? this.bloomStrength : 0;
    const focus = this.focusDistance > 0 ? this.focusDistance : targetDistance;
    uniforms.focus.value = focus;
    // Of a point at distance d: aperture · |d − focus| / d, seen in the plane of focus.
    uniforms.blur.value = this.aperture / (2 * focus * Math.tan((camera.fov * Math.PI) / 360));
    uniforms.range.value.set(camera.near, camera.far);
    uniforms.aspect.value = gathered.width / gathered.height;
    this.#draw(this.#composite, gathered, null);
  }

  dispose(): void {
    this.#gathered?.depthTexture?.dispose();
    this.#gathered?.dispose();
    for (const level of this.#levels) level.dispose();
    for (const material of [this.#down, this.#up, this.#composite]) material.dispose();
    this.#quad.dispose();
  }
}
