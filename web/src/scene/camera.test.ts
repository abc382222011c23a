import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { aim } from "./camera";

const POSE = { position: new Vector3(-1.6, 1.5, 2.4), target: new Vector3(0.1, 1.2, 0.3), fov: 0.5, roll: 0 };

function seen(point: Vector3, roll: number): Vector3 {
  const camera = new PerspectiveCamera(30, 16 / 9);
  aim(camera, { ...POSE, roll });
  camera.updateMatrixWorld();
  return point.clone().project(camera);
}

describe("aim", () => {
  it("puts the target in the middle of the picture, whatever the roll", () => {
    for (const roll of [0, 0.3, -1]) {
      const { x, y } = seen(POSE.target, roll);
      expect(Math.hypot(x, y)).toBeLessThan(1e-6);
    }
  });

  it("tips the picture's top to the left for a positive roll", () => {
    const above = POSE.target.clone().setY(POSE.target.y + 0.3);
    expect(seen(above, 0).x).toBeCloseTo(0, 6);
    expect(seen(above, 0.2).x).toBeLessThan(-0.01);
    expect(seen(above, -0.2).x).toBeGreaterThan(0.01);
  });
});
