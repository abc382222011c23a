import { Object3D, Ray, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import type { RigModel } from "../rig";
import { DRUM_PIECES } from "./blocks/staff";
import { Players } from "./players";

/** A body of joints alone, standing somewhere. */
function body(x: number, z: number, facing: number): RigModel {
  const object = new Object3D();
  const heights = { hips: 0.9, head: 1.6, leftFoot: 0.08, rightFoot: 0.08 };
  const joints = new Map(
    Object.entries(heights).map(([name, y]) => {
      const joint = new Object3D();
      joint.position.y = y;
      object.add(joint);
      return [name, joint];
    }),
  );
  object.position.set(x, 0, z);
  object.rotation.y = facing;
  object.updateMatrixWorld();
  return {
    object,
    findJoint: (name: string) => joints.get(name) ?? null,
    findContact: () => null,
    findZone: () => null,
  } as unknown as RigModel;
}

/** A kit that stands somewhere, with a snare and its places for the notes. */
function kit(x: number, z: number): RigModel {
  const node = new Object3D();
  node.position.set(x, 0.2, z);
  node.updateMatrixWorld();
  const contacts: Record<string, Vector3> = { lane: new Vector3(0, 1.1, 1), lane_kick: new Vector3(0, 0.3, 1.1) };
  const point = (offset: Vector3 | undefined) => (offset === undefined ? null : { node, offset });
  return {
    object: node,
    findJoint: (name: string) => (name === "kit" ? node : null),
    findContact: (name: string) => point(contacts[name]),
    findZone: (piece: string) => point(["snare", "kick"].includes(piece) ? new Vector3(0, 0.6, 0.4) : undefined),
  } as unknown as RigModel;
}

const bodies = [body(-0.62, 0, 0.3), body(0.62, 0, -0.3)];
const players = new Players(bodies.map((model, player) => ({ model, player })));

function ray(from: [number, number, number], to: [number, number, number]): Ray {
  const origin = new Vector3(...from);
  return new Ray(origin, new Vector3(...to).sub(origin).normalize());
}

describe("Players", () => {
  it("says where everybody stands, and which way", () => {
    const stands = players.stands();
    expect(stands.map(({ x }) => x)).toEqual([-0.62, 0.62]);
    expect(stands[0]?.facing).toBeCloseTo(0.3);
    expect(stands[1]?.facing).toBeCloseTo(-0.3);
  });

  it.each([
    [[-0.62, 1.2, 0], 0],
    [[0.62, 0.2, 0], 1],
    [[0.8, 1.5, 0], 1],
    [[0, 1.2, 0], null],
    [[-0.62, 2.4, 0], null],
  ] as const)("is pointed at %j: %s", ([x, y, z], player) => {
    expect(players.pick(ray([x, 1.4, 4], [x, y, z]))).toBe(player);
  });

  it("is whoever stands in front, seen along the row", () => {
    expect(players.pick(ray([-5, 1.3, 0], [5, 1.3, 0]))).toBe(0);
    expect(players.pick(ray([5, 1.3, 0], [-5, 1.3, 0]))).toBe(1);
  });

  it("has the notes come to a kit's own place, and each hit to its piece", () => {
    const models = [body(0, 0, 0), body(0, -2, 0), kit(0, -2)];
    const band = new Players(models.map((model, i) => ({ model, player: Math.min(i, 1) })));
    expect(band.atKits()).toEqual([false, true]);
    const [starts, pieces] = [2, 2 * DRUM_PIECES.length].map((count) =>
      Array.from({ length: count }, () => new Vector3(9, 9, 9)),
    );
    band.readLanes(starts ?? [], pieces ?? []);
    expect(starts?.map((at) => at.toArray())).toEqual([
      [9, 9, 9],
      [0, 1.3, -1],
    ]);
    const of = (player: number, piece: string) =>
      pieces?.[player * DRUM_PIECES.length + DRUM_PIECES.indexOf(piece)]?.toArray().map((x) => Number(x.toFixed(3)));
    expect(of(1, "snare")).toEqual([0, 0.8, -1.6]);
    expect(of(1, "kick")).toEqual([0, 0.5, -0.9]);
    expect(of(0, "snare")).toEqual([9, 9, 9]);
  });

  it("is nobody on an empty stage", () => {
    expect(new Players([]).pick(ray([0, 1, 4], [0, 1, 0]))).toBeNull();
  });
});
