import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { aim } from "./camera";
import { findPreset, type FramedView } from "./camera-presets";
import { castView, playerView } from "./cast-views";
import { SHOW_ASPECT, keptWidth } from "./framing";
import type { Stand } from "./players";
import { ROOM } from "./room/plan";

const CASTS: Stand[][] = [
  [{ x: 0, z: 0, facing: 0 }],
  [
    { x: -0.62, z: 0, facing: 0.3 },
    { x: 0.62, z: 0, facing: -0.3 },
  ],
  [
    { x: 0, z: 0, facing: 0 },
    { x: -1.55, z: 0.35, facing: 0.6 },
    { x: 1.55, z: 0.35, facing: -0.6 },
  ],
];

function seen(view: FramedView, point: Vector3): Vector3 {
  const camera = new PerspectiveCamera((view.fov * 180) / Math.PI, SHOW_ASPECT, 0.05, 60);
  const [position, target] = [new Vector3(...view.position), new Vector3(...view.target)];
  aim(camera, { position, target, fov: view.fov, roll: 0 });
  camera.updateMatrixWorld();
  return point.clone().project(camera);
}

describe("castView", () => {
  it.each([16 / 9, 390 / 844, 1440 / 900])("shows everybody from crown to sole in a window of aspect %f", (aspect) => {
    for (const stands of CASTS) {
      const view = castView(stands, aspect);
      for (const { x, z } of stands) {
        for (const side of [-0.35, 0.35]) {
          for (const y of [0, 1.75]) {
            const point = seen(view, new Vector3(x + side, y, z));
            expect(Math.abs(point.x)).toBeLessThan(keptWidth(aspect));
            expect(Math.abs(point.y)).toBeLessThan(1);
          }
        }
      }
    }
  });

  it("stays in the room", () => {
    for (const stands of CASTS) {
      const [x, y, z] = castView(stands, 0.4).position;
      expect(Math.abs(x)).toBeLessThan(ROOM.halfWidth);
      expect(y).toBeGreaterThan(0.5);
      expect(z).toBeLessThan(ROOM.front);
    }
  });
});

describe("playerView", () => {
  it("is the three-quarter view of who stands in the middle", () => {
    const { position, target, fov } = playerView({ x: 0, z: 0, facing: 0 });
    const preset = findPreset("three_quarter");
    expect([position, target, fov]).toEqual([preset?.position, preset?.target, preset?.fov]);
  });

  it("turns and moves with the player", () => {
    const [middle, there] = [playerView({ x: 0, z: 0, facing: 0 }), playerView({ x: 1, z: 2, facing: Math.PI / 2 })];
    const [x, y, z] = middle.position;
    expect(there.position[0]).toBeCloseTo(1 + z);
    expect(there.position[1]).toBeCloseTo(y);
    expect(there.position[2]).toBeCloseTo(2 - x);
    expect(playerView({ x: 0, z: 0, facing: -0.6 })).toEqual(middle);
  });
});
