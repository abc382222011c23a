import { Line3, PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { aim } from "./camera";
import { findPreset, type FramedView } from "./camera-presets";
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

/** From the chin to the hair, and from ear to ear, of a head that leans and turns. */
const FACE: readonly Point[] = [-0.1, 0, 0.1].flatMap((x) => [1.15, 1.25, 1.36].map((y): Point => [x, y, 0.1]));

/** The cymbals that stand about a face, as discs: the joints' places and the radii of their rig, metres. */
const CYMBALS: readonly (readonly [...Point, radius: number])[] = [
  [0.4, 0.892, 0.58, 0.178],
  [-0.7, 1.01, 0.56, 0.254],
  [0.35, 1.16, 0.77, 0.203],
  [-0.49, 1.2, 0.74, 0.229],
  [-0.84, 1.15, 0.32, 0.203],
  [-0.13, 1.112, 0.853, 0.127],
];

/** How far from the ways of a camera to points the nearest cymbal lies, metres; all as balls of their radius, in the kit's frame. */
function clearance({ position }: FramedView, points: readonly Point[]): number {
  const from = new Vector3(position[0] - KIT.x, position[1] - KIT.y, position[2] - KIT.z);
  const away = points.flatMap((point) =>
    CYMBALS.map(([x, y, z, radius]) => {
      const line = new Line3(from, new Vector3(...point));
      const [middle, nearest] = [new Vector3(x, y, z), new Vector3()];
      line.closestPointToPoint(middle, true, nearest);
      // A cymbal lies nearly flat: what passes a hand over or under it passes it.
      return Math.abs(nearest.y - y) > 0.1 ? 1 : nearest.distanceTo(middle) - radius;
    }),
  );
  return Math.min(...away);
}

const SHOWS: Readonly<Record<string, readonly Point[]>> = {
  kit_behind: [SNARE, HI_HAT, HEAD],
  kit_overhead: [SNARE, HI_HAT, RIGHT_PEDAL, LEFT_PEDAL, HEAD],
  kit_hi_hat: [SNARE, HI_HAT],
  kit_feet: [RIGHT_PEDAL, LEFT_PEDAL],
  whole_figure: [SNARE, HI_HAT, HEAD, RIGHT_PEDAL, [-0.19, 0.05, 1.12], [0, 1.55, 0], [-0.9, 1.15, 0.32]],
  three_quarter: [SNARE, HI_HAT, HEAD, RIGHT_PEDAL, [0, 1.55, 0], [-0.9, 1.15, 0.32]],
  face: FACE,
  player: [SNARE, HI_HAT],
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
    expect(Object.keys(SHOWS)).toEqual([
      ...KIT_VIEWS.map(({ name }) => name),
      ...["whole_figure", "three_quarter", "face", "player"],
    ]);
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

  it("sees the face past every cymbal, which the view from straight ahead of a standing player does not", () => {
    const face = kitView("face", KIT);
    const preset = findPreset("face");
    if (face === null || preset === null) throw new Error("none");
    expect(clearance(face, FACE)).toBeGreaterThan(0.02);
    expect(clearance(preset, FACE)).toBeLessThan(0);
  });

  it.each([
    ["two before the kit", [-0.62, 0.62].map((x) => ({ x, z: 0, facing: 0 }))],
    ["three", [{ x: 0, z: 0, facing: 0 }, ...[-1.55, 1.55].map((x) => ({ x, z: 0.35, facing: 0 }))]],
  ] as const)("has nobody of %s in the way of the drummer", (_, others) => {
    for (const name of ["whole_figure", "three_quarter", "face"]) {
      const view = kitView(name, KIT, others);
      if (view === null) throw new Error(name);
      const line = new Line3(new Vector3(...view.position), new Vector3(...view.target));
      for (const { x, z } of others) {
        const [nearest, head] = [new Vector3(), new Vector3(x, 1.55, z)];
        line.closestPointToPoint(head, true, nearest);
        expect([name, x, nearest.distanceTo(head) > 0.4]).toEqual([name, x, true]);
        expect([name, x, Math.hypot(view.position[0] - x, view.position[2] - z) > 0.5]).toEqual([name, x, true]);
      }
    }
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
