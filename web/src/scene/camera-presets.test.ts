import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { aim } from "./camera";
import { CAMERA_PRESETS, findPreset, lookedAt } from "./camera-presets";
import { SHOW_ASPECT } from "./framing";

/** About where they are while she plays, metres. */
const FINGERS = new Vector3(0.03, 1.49, 0.39);
const SOLES = new Vector3(0, 0, 0.05);
const CROWN = new Vector3(0, 1.66, 0.05);

function seen(name: string, point: Vector3): Vector3 {
  const preset = findPreset(name);
  if (preset === null) throw new Error(`no preset ${name}`);
  const camera = new PerspectiveCamera((preset.fov * 180) / Math.PI, SHOW_ASPECT, 0.05, 60);
  aim(camera, {
    position: new Vector3(...preset.position),
    target: new Vector3(...preset.target),
    fov: preset.fov,
    roll: 0,
  });
  camera.updateMatrixWorld();
  return point.clone().project(camera);
}

describe("CAMERA_PRESETS", () => {
  it.each(CAMERA_PRESETS.map(({ name }) => name))("%s never cuts the fingers off", (name) => {
    const { x, y, z } = seen(name, FINGERS);
    expect(Math.max(Math.abs(x), Math.abs(y))).toBeLessThan(0.92);
    expect(z).toBeLessThan(1);
  });

  it("shows the whole figure where it says so", () => {
    for (const name of ["whole_figure", "hall"]) {
      for (const point of [SOLES, CROWN]) expect(Math.abs(seen(name, point).y)).toBeLessThan(0.97);
    }
  });

  it("has each name once", () => {
    expect(new Set(CAMERA_PRESETS.map(({ name }) => name)).size).toBe(CAMERA_PRESETS.length);
    expect(findPreset("nowhere")).toBeNull();
  });
});

describe("lookedAt", () => {
  it("is on the line of sight, as far as what is looked about", () => {
    const seenPoint = lookedAt(new Vector3(0, 1, 3), new Vector3(0, 0, -1), new Vector3(0.2, 1.1, 0));
    expect(seenPoint.toArray()).toEqual([0, 1, 0]);
  });
});
