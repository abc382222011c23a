import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { aim } from "./camera";
import type { FramedView } from "./camera-presets";
import { SHOW_ASPECT } from "./framing";
import { drummerView, KIT_VIEWS, kitView, type KitPlace } from "./kit-views";
import { ROOM } from "./room/plan";

/** Where the room has its kit. */
const KIT: KitPlace = { x: 0, y: 0.2, z: -2.15, facing: 0, mirrored: false };
const [SNARE, HI_HAT, RIGHT_PEDAL, LEFT_PEDAL, HEAD] = [
  [0.04, 0.65, 0.4],
  [0.4, 0.87, 0.58],
  [-0.19, 0.05, 0.55],
  [0.31, 0.05, 0.4],
  [0, 1.35, 0],
] as const;

type Point = readonly [number, number, number];

const SHOWS: Readonly<Record<string, readonly Point[]>> = {
  kit_behind: [SNARE, HI_HAT, HEAD],
  kit_overhead: [SNARE, HI_HAT, RIGHT_PEDAL, LEFT_PEDAL, HEAD],
  kit_hi_hat: [SNARE, HI_HAT],
  kit_feet: [RIGHT_PEDAL, LEFT_PEDAL],
  three_quarter: [SNARE, HI_HAT, HEAD, RIGHT_PEDAL, [0, 1.55, 0], [-0.9, 1.15, 0.32]],
};

function seen(view: FramedView, [x, y, z]: Point): Vector3 {
  const camera = new PerspectiveCamera((view.fov * 180) / Math.PI, SHOW_ASPECT, 0.05, 60);
  const [position, target] = [new Vector3(...view.position), new Vector3(...view.target)];
  aim(camera, { position, target, fov: view.fov, roll: 0 });
  camera.updateMatrixWorld();
  return new Vector3(x + KIT.x, y + KIT.y, z + KIT.z).project(camera);
}

describe("kitView", () => {
  it("shows within its frame what it is called after", () => {
    expect(Object.keys(SHOWS)).toEqual([...KIT_VIEWS.map(({ name }) => name), "three_quarter"]);
    for (const [name, points] of Object.entries(SHOWS)) {
      const view = kitView(name, KIT);
      if (view === null) throw new Error(name);
      for (const point of points) {
        const { x, y, z } = seen(view, point);
        expect([name, point, Math.abs(x) < 0.95, Math.abs(y) < 0.95, z < 1]).toEqual([name, point, true, true, true]);
      }
    }
  });

  it("stays in the room, and looks over the drummer the way he looks", () => {
    for (const { name } of KIT_VIEWS) {
      const view = kitView(name, KIT);
      expect(Math.abs(view?.position[0] ?? Infinity)).toBeLessThan(ROOM.halfWidth);
      expect(view?.position[1]).toBeLessThan(ROOM.height);
      expect(view?.position[2]).toBeGreaterThan(ROOM.back);
    }
    const overhead = kitView("kit_overhead", KIT);
    if (overhead === null) throw new Error("none");
    const [snare, ahead] = [seen(overhead, SNARE), seen(overhead, [SNARE[0], SNARE[1], SNARE[2] + 0.5])];
    expect(ahead.y).toBeGreaterThan(snare.y + 0.2);
    expect(seen(overhead, HI_HAT).x).toBeLessThan(snare.x);
  });

  it("turns and moves with the kit", () => {
    const [x, y, z] = drummerView({ x: 0, y: 0, z: 0, facing: 0, mirrored: false }).position;
    const turned = drummerView({ x: 1, y: 0.5, z: 2, facing: Math.PI / 2, mirrored: false }).position;
    expect(turned[0]).toBeCloseTo(1 + z);
    expect(turned[1]).toBeCloseTo(y + 0.5);
    expect(turned[2]).toBeCloseTo(2 - x);
  });

  it("sees a left-handed player's kit from the other side", () => {
    for (const name of Object.keys(SHOWS)) {
      const [view, other] = [kitView(name, KIT), kitView(name, { ...KIT, mirrored: true })];
      if (view === null || other === null) throw new Error(name);
      for (const point of ["position", "target"] as const) {
        const [x, y, z] = view[point];
        expect([name, ...other[point]]).toEqual([name, expect.closeTo(-x), y, expect.closeTo(z)]);
      }
      const [hat, mirrored] = [seen(view, HI_HAT), seen(other, [-HI_HAT[0], HI_HAT[1], HI_HAT[2]])];
      expect(mirrored.x).toBeCloseTo(-hat.x);
      expect(mirrored.y).toBeCloseTo(hat.y);
    }
  });

  it("has no view of valves", () => {
    expect(kitView("valves", KIT)).toBeNull();
  });
});
