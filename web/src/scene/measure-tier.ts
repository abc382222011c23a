/** How much a device can draw, by a short measurement. */

import type { Tier } from "./tiers";

/** Side of the measured picture, pixels. */
const SIDE = 256;

/** Drawn so often at once, the time of one drawing shows beside the time of asking for it. */
const DRAWS = 24;

/** A device that takes this long for one picture, milliseconds, is not asked for more. */
const LONG = 12;

/** As heavy a pixel as the stage's: a surface under three lights is some hundred operations. */
const FRAGMENT = `#version 300 es
precision highp float;
in vec2 place;
out vec4 light;
void main() {
  vec3 sum = vec3(place, 0.5);
  for (int i = 0; i < 160; i++) sum = fract(sum * 1.37 + sqrt(abs(sum.yzx)) * 0.61);
  light = vec4(sum, 1.0);
}`;
const VERTEX = `#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(place, 0.0, 1.0);
}`;

/**
 * The slowest that still gets a tier, nanoseconds a measured pixel. Some four thousand operations make one: a card of a
 * tera-operation a second takes about 4 ns, a small one within a processor 10 to 20, a processor alone several hundred.
 */
const SLOWEST: readonly (readonly [tier: Tier, nanoseconds: number])[] = [
  ["full", 6],
  ["medium", 40],
];

/** The tier of a device that draws a measured pixel in this time; a handheld one keeps its battery. */
export function tierOf(nanoseconds: number, handheld: boolean): Tier {
  const tier = SLOWEST.find(([, slowest]) => nanoseconds <= slowest)?.[0] ?? "low";
  return tier === "full" && handheld ? "medium" : tier;
}

function compile(gl: WebGL2RenderingContext, type: number, source: string): WebGLShader | null {
  const shader = gl.createShader(type);
  if (shader === null) return null;
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}

/** Time of one pixel, nanoseconds; null where there is no WebGL 2 to measure. */
function measurePixel(now: () => number): number | null {
  const canvas = new OffscreenCanvas(SIDE, SIDE);
  const gl = canvas.getContext("webgl2", { antialias: false, powerPreference: "high-performance" });
  if (gl === null) return null;
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = compile(gl, type, source);
    if (shader !== null) gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const pixel = new Uint8Array(4);
  /** How long some drawings take, milliseconds. */
  const time = (draws: number): number => {
    const begun = now();
    for (let i = 0; i < draws; i++) gl.drawArrays(gl.TRIANGLES, 0, 3);
    // Waits until they are drawn.
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return now() - begun;
  };
  time(1);
  const one = time(1);
  const each = one > LONG ? one : Math.max(0, time(DRAWS) - one) / (DRAWS - 1);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return (each * 1e6) / (SIDE * SIDE);
}

/**
 * Measure, for some tenths of a second at most, how much this device can draw.
 *
 * @param handheld a finger is its pointer.
 * @returns low where there is nothing to measure; the stage then says why.
 */
export function measureTier(handheld: boolean): Tier {
  if (typeof OffscreenCanvas === "undefined") return handheld ? "low" : "medium";
  const nanoseconds = measurePixel(() => performance.now());
  return nanoseconds === null ? "low" : tierOf(nanoseconds, handheld);
}
