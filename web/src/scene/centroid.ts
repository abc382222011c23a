/**
 * Where a triangle covers a part of a pixel, its normal, colour and texture are taken at that part and not past the
 * triangle's edge: there they would run on to what the surface never is, and one such sample is a spark.
 */

import { ShaderChunk } from "three";

const CHUNKS = [
  "normal_pars_vertex",
  "normal_pars_fragment",
  "color_pars_vertex",
  "color_pars_fragment",
  "uv_pars_vertex",
  "uv_pars_fragment",
] as const;

/** Change three.js's shaders, once, before the first of them is compiled. */
export function sampleInside(): void {
  for (const name of CHUNKS)
    ShaderChunk[name] = ShaderChunk[name].replace(/(centroid )?\bvarying\b/g, "centroid varying");
}
