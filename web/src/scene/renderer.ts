/** The WebGL renderer, or a plain word about why there is none. */

import { NeutralToneMapping, PCFShadowMap, SRGBColorSpace, WebGLRenderer } from "three";

import { sampleInside } from "./centroid";
import { StageUnavailableError } from "./errors";
import { page } from "../words/page/en";
import type { TierSettings } from "./tiers";

/** What `stage/exposure` multiplies: the room's light was set by it. */
export const EXPOSURE = 1.25;

/**
 * Make the renderer on a canvas.
 *
 * @param transparent whether what is not drawn lets through what lies behind the canvas.
 * @throws StageUnavailableError where the browser gives no WebGL 2.
 */
export function createRenderer(canvas: HTMLCanvasElement, tier: TierSettings, transparent: boolean): WebGLRenderer {
  const attributes: WebGLContextAttributes = {
    alpha: transparent,
    // What is drawn into the canvas has its edges smoothed before (picture.ts), or not at all.
    antialias: false,
    powerPreference: "high-performance",
  };
  const context = canvas.getContext("webgl2", attributes);
  if (context === null) {
    throw new StageUnavailableError(page.noWebGl);
  }
  sampleInside();
  const renderer = new WebGLRenderer({ canvas, context, ...attributes });
  renderer.outputColorSpace = SRGBColorSpace;
  // Of the mappings at hand the one that keeps hues: skin in full light stays skin, drawn colours stay bright.
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = tier.shadowMapSize > 0;
  renderer.shadowMap.type = PCFShadowMap;
  renderer.info.autoReset = false;
  return renderer;
}
