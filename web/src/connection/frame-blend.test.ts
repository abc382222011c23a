import { describe, expect, it } from "vitest";
import { FrameBlend } from "./frame-blend";
import { SAMPLE_MANIFEST } from "./sample-frames";

const blend = new FrameBlend(SAMPLE_MANIFEST);

/** Floats of a sample frame: hips turned by an angle about Y, the rest as given. */
function floatsOf(angle: number, { sign = 1, root = 0, light = 0, shot = 0 } = {}): Float32Array {
  const hips = [0, sign * Math.sin(angle / 2), 0, sign * Math.cos(angle / 2)];
  return new Float32Array([...hips, 0, 0, 0, 1, root, 0, 0, 0, light, shot, ...hips]);
}

function blended(a: Float32Array, b: Float32Array, u: number): number[] {
  const out = new Float32Array(blend.length);
  blend.blend(a, b, u, out);
  return [...out];
}

describe("FrameBlend", () => {
  it("covers the frame behind its header", () => {
    expect(blend.length).toBe(18);
  });

  it("turns by the share of the angle", () => {
    const [x, y, z, w] = blended(floatsOf(0.1), floatsOf(0.3), 0.5);
    expect([x, z]).toEqual([0, 0]);
    expect(2 * Math.atan2(y ?? 0, w ?? 0)).toBeCloseTo(0.2, 6);
  });

  it("takes the shorter way when the signs of two quaternions differ", () => {
    const [, y, , w] = blended(floatsOf(0.1), floatsOf(0.3, { sign: -1 }), 0.5);
    expect(2 * Math.atan2(y ?? 0, w ?? 0)).toBeCloseTo(0.2, 6);
  });

  it("keeps every quaternion unit, orientation parameters too", () => {
    const out = blended(floatsOf(0.2), floatsOf(1.7), 0.37);
    for (const start of [0, 4, 14]) {
      expect(Math.hypot(...out.slice(start, start + 4))).toBeCloseTo(1, 6);
    }
  });

  it("goes straight for roots and numbers, and holds what must not be blended", () => {
    const out = blended(floatsOf(0, { root: 1, light: 2, shot: 3 }), floatsOf(0, { root: 2, light: 4, shot: 5 }), 0.75);
    expect(out[8]).toBeCloseTo(1.75, 6);
    expect(out[12]).toBeCloseTo(3.5, 6);
    expect(out[13]).toBe(3);
  });

  it("copies either frame at the ends", () => {
    const a = floatsOf(0.1, { root: 1 });
    const b = floatsOf(0.9, { root: 2, shot: 1 });
    expect(blended(a, b, 0)).toEqual([...a]);
    expect(blended(a, b, 1)).toEqual([...b]);
  });
});
