import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { fitFrame, type Insets, keptWidth, SHOW_ASPECT, widen } from "./framing";

const DEGREES = 180 / Math.PI;
const FOVS = [0.1, 0.26, 0.5, 1.0, 1.6];
const NONE: Insets = { top: 0, right: 0, bottom: 0, left: 0 };
const WINDOWS: readonly [width: number, height: number][] = [
  [1280, 720],
  [2560, 1080],
  [1024, 768],
  [390, 844],
  [844, 390],
];
const PANELS: readonly Insets[] = [
  NONE,
  { top: 56, right: 0, bottom: 190, left: 0 },
  { top: 0, right: 320, bottom: 160, left: 0 },
];

/** Where the corners of the part that is kept of the show's frame fall in a window, pixels from its top left. */
function frameCorners(fov: number, width: number, height: number, insets: Insets): Vector3[] {
  const { widening, shiftX, shiftY } = fitFrame(width, height, insets);
  const camera = new PerspectiveCamera(widen(fov, widening) * DEGREES, width / height);
  camera.setViewOffset(width, height, -shiftX, -shiftY, width, height);
  const up = Math.tan(fov / 2);
  const across = SHOW_ASPECT * keptWidth((width - insets.left - insets.right) / (height - insets.top - insets.bottom));
  return [-1, 1].flatMap((x) =>
    [-1, 1].map((y) => {
      const seen = new Vector3(x * up * across, y * up, -1).applyMatrix4(camera.projectionMatrix);
      return new Vector3(((1 + seen.x) / 2) * width, ((1 - seen.y) / 2) * height, 0);
    }),
  );
}

describe("fitFrame", () => {
  it("leaves the show's own shape and wider windows their height", () => {
    expect(fitFrame(1280, 720, NONE)).toEqual({ widening: 1, shiftX: 0, shiftY: 0 });
    expect(fitFrame(2560, 1080, NONE).widening).toBe(1);
  });

  it("keeps its part of the frame in what is free, and touches two of its sides", () => {
    for (const fov of FOVS) {
      for (const [width, height] of WINDOWS) {
        for (const insets of PANELS) {
          if (insets.right > width / 2 || insets.bottom > height / 2.5) continue;
          const corners = frameCorners(fov, width, height, insets);
          const xs = corners.map(({ x }) => x);
          const ys = corners.map(({ y }) => y);
          const room = [
            Math.min(...xs) - insets.left,
            width - insets.right - Math.max(...xs),
            Math.min(...ys) - insets.top,
            height - insets.bottom - Math.max(...ys),
          ];
          for (const free of room) expect(free).toBeGreaterThan(-1e-3);
          expect(Math.min(Math.max(...room.slice(0, 2)), Math.max(...room.slice(2)))).toBeLessThan(1e-3);
        }
      }
    }
  });

  it("gives up sides in narrow windows alone, and never more than a third of the width", () => {
    expect(keptWidth(SHOW_ASPECT)).toBe(1);
    expect(keptWidth(3)).toBe(1);
    expect(keptWidth(4 / 3)).toBeGreaterThan(0.8);
    expect(keptWidth(0.5)).toBeCloseTo(0.66, 12);
  });

  it("leaves the picture a part of the window, whatever lies over it", () => {
    const { widening } = fitFrame(390, 844, { top: 500, right: 0, bottom: 500, left: 0 });
    expect(widening).toBeLessThan(5);
  });
});

describe("widen", () => {
  it("never turns the picture inside out", () => {
    expect(widen(2, 40)).toBeLessThan(Math.PI);
  });
});
