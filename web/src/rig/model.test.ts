import { BufferAttribute, BufferGeometry, Group, Mesh, Object3D } from "three";
import { describe, expect, it } from "vitest";

import { LayoutError, ParameterIndex } from "../scene/frame";
import { readRigDocument } from "./document";
import type { LoadedRig } from "./load";
import { RigModel } from "./model";

const PARAMETERS = ["trumpet/valve/1", "slide/turn", "face/smile", "players/2/trumpet/valve/1", "trumpet/mute"].map(
  (path, i) => ({
    path,
    type: "number" as const,
    offset: 72 + 4 * i,
    length: 1,
    blend: true,
  }),
);
const LAYOUT = { name: "player", player: 0, rig: "figure", joints: ["root", "tip"], offset: 24, root_offset: 56 };

function named(name: string, parent: Object3D): Object3D {
  const node = new Object3D();
  node.name = name;
  parent.add(node);
  return node;
}

function face(scene: Object3D): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(9), 3));
  const target = new BufferAttribute(new Float32Array(9), 3);
  target.name = "mouthSmile";
  geometry.morphAttributes.position = [target];
  const mesh = new Mesh(geometry);
  scene.add(mesh);
  return mesh;
}

function figure() {
  const scene = new Group();
  const root = named("root", scene);
  const tip = named("tip", root);
  const valve = named("valve1", root);
  valve.position.set(0.1, 0.2, 0.3);
  const turning = named("turning", root);
  const mute = named("mute", root);
  const meshes = [face(scene), face(scene)];
  const rest = { translation: [0, 0, 0], rotation: [0, 0, 0, 1] };
  const document = readRigDocument(
    {
      name: "figure",
      models: { full: "f", medium: "m", low: "l" },
      joints: [
        // The file's order is not the frame's.
        { name: "tip", parent: "root", node: "tip", ...rest },
        { name: "root", parent: null, node: "root", ...rest },
      ],
      parts: [
        { node: "valve1", parameter: "trumpet/valve/1", travel: [0, -0.0165, 0] },
        { node: "turning", parameter: "slide/turn", axis: [0, 0, 2], angle: Math.PI },
        { node: "mute", parameter: "trumpet/mute", shown_from: 0.5 },
      ],
      morphs: [{ parameter: "face/smile", target: "mouthSmile" }],
      contacts: [{ name: "bell", joint: "tip", offset: [0, 0, 1] }],
    },
    "figure",
  );
  const rig: LoadedRig = { document, scene, joints: [tip, root], parts: [valve, turning, mute] };
  return { rig, root, tip, valve, turning, meshes };
}

/** root and tip rotations, root position, padding, parameters. */
const FLOATS = new Float32Array([0.1, 0.2, 0.3, 0.9, 0.5, 0.5, 0.5, 0.5, 1, 2, 3, 0, 1, 0.5, 0.25, 0.75, 1]);

describe("RigModel", () => {
  it("sets each joint by name, and the root's position", () => {
    const { rig, root, tip } = figure();
    const model = new RigModel(rig, LAYOUT, new ParameterIndex(PARAMETERS));
    model.pose(FLOATS);
    expect(root.quaternion.toArray()).toEqual([0.1, 0.2, 0.3, 0.9].map(Math.fround));
    expect(tip.quaternion.toArray()).toEqual([0.5, 0.5, 0.5, 0.5]);
    expect(root.position.toArray()).toEqual([1, 2, 3]);
    const read: Record<string, [number, number, number, number]> = {};
    model.readRotations(read);
    expect(read).toEqual({ root: root.quaternion.toArray(), tip: [0.5, 0.5, 0.5, 0.5] });
  });

  it("moves parts from their rest by their parameter, and comes back", () => {
    const { rig, valve, turning } = figure();
    const model = new RigModel(rig, LAYOUT, new ParameterIndex(PARAMETERS));
    model.pose(FLOATS);
    expect(valve.position.toArray()).toEqual([0.1, 0.2 - 0.0165, 0.3]);
    expect(2 * Math.acos(turning.quaternion.w)).toBeCloseTo(Math.PI / 2, 9);
    expect(turning.quaternion.z).toBeGreaterThan(0);
    model.pose(FLOATS.map((value, i) => (i < 12 ? value : 0)));
    expect(valve.position.toArray()).toEqual([0.1, 0.2, 0.3]);
    expect(turning.quaternion.w).toBeCloseTo(1, 9);
  });

  it("shows a part from its value on, and takes it away below", () => {
    const { rig } = figure();
    const model = new RigModel(rig, LAYOUT, new ParameterIndex(PARAMETERS));
    const mute = rig.scene.getObjectByName("mute");
    model.pose(FLOATS.map((value, i) => (i === 16 ? 0 : value)));
    expect(mute?.visible).toBe(false);
    model.pose(FLOATS);
    expect(mute?.visible).toBe(true);
  });

  it("sets a morph on every mesh that has it", () => {
    const { rig, meshes } = figure();
    new RigModel(rig, LAYOUT, new ParameterIndex(PARAMETERS)).pose(FLOATS);
    expect(meshes.map((mesh) => mesh.morphTargetInfluences)).toEqual([[0.25], [0.25]]);
  });

  it("gives another player the parameters under that player's path", () => {
    const { rig, valve } = figure();
    const layout = { ...LAYOUT, name: "players/2/trumpet" };
    new RigModel(rig, layout, new ParameterIndex(PARAMETERS)).pose(FLOATS);
    expect(valve.position.y).toBeCloseTo(0.2 - 0.75 * 0.0165, 9);
  });

  it("finds a contact on its joint", () => {
    const { rig, tip } = figure();
    const model = new RigModel(rig, LAYOUT, new ParameterIndex(PARAMETERS));
    expect(model.findContact("bell")?.node).toBe(tip);
    expect(model.findContact("bell")?.offset.toArray()).toEqual([0, 0, 1]);
    expect(model.findContact("lips")).toBeNull();
  });

  it("names the joints that the rig has not", () => {
    const { rig } = figure();
    const layout = { ...LAYOUT, joints: ["root", "tail"] };
    expect(() => new RigModel(rig, layout, new ParameterIndex([]))).toThrow(LayoutError);
    expect(() => new RigModel(rig, layout, new ParameterIndex([]))).toThrow(/rig figure has not: tail/);
  });
});
