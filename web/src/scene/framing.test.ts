import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { fitFieldOfView, SHOW_ASPECT } from "./framing";

const DEGREES = 180 / Math.PI;
const FOVS = [0.1, 0.26, 0.5, 1.0, 1.6];

/** Where the corners of the show's 16:9 frame fall in a window, in clip space. */
function frameCorners(fov: number, aspect: number): Vector3[] {
  const camera = new PerspectiveCamera(fitFieldOfView(fov, aspect) * DEGREES, aspect);
  camera.updateProjectionMatrix();
  const up = Math.tan(fov / 2);
  return [-1, 1].flatMap((x) =>
    [-1, 1].map((y) => new Vector3(x * up * SHOW_ASPECT, y * up, -1).applyMatrix4(camera.projectionMatrix)),
  );
}

describe("fitFieldOfView", () => {
  it("leaves the show's own shape and wider windows their height", () => {
    for (const fov of FOVS) {
      expect(fitFieldOfView(fov, SHOW_ASPECT)).toBe(fov);
      expect(fitFieldOfView(fov, 21 / 9)).toBe(fov);
    }
  });

  it("touches the window's sides with the frame's where the window is narrower", () => {
    for (const fov of FOVS) {
      for (const aspect of [0.6, 1, 4 / 3, 1.6]) {
        const corners = frameCorners(fov, aspect);
        for (const corner of corners) {
          expect(Math.abs(corner.x)).toBeCloseTo(1, 6);
          expect(Math.abs(corner.y)).toBeLessThanOrEqual(1);
        }
      }
    }
  });

  it("never turns the picture inside out", () => {
    expect(fitFieldOfView(2, 0.05)).toBeLessThan(Math.PI);
  });
});
