import { Object3D } from "three";
import { describe, expect, it } from "vitest";

import { readRigDocument, type RigDocument } from "./document";
import { checkSkeleton } from "./skeleton-check";

const HALF = Math.SQRT1_2;

const DOCUMENT: RigDocument = readRigDocument(
  {
    name: "arm",
    models: { full: "f", medium: "m", low: "l" },
    joints: [
      { name: "shoulder", parent: null, translation: [0, 1, 0], rotation: [0, 0, 0, 1], node: "shoulder" },
      { name: "elbow", parent: "shoulder", translation: [0.3, 0, 0], rotation: [0, HALF, 0, HALF], node: "elbow" },
      { name: "wrist", parent: "elbow", translation: [0.25, 0, 0], rotation: [0, 0, 0, 1], node: "wrist" },
    ],
  },
  "arm",
);

function arm(): Object3D[] {
  const nodes = DOCUMENT.joints.map((joint) => {
    const node = new Object3D();
    node.position.set(...joint.translation);
    node.quaternion.set(...joint.rotation);
    return node;
  });
  nodes.slice(1).forEach((node, i) => nodes[i]?.add(node));
  return nodes;
}

describe("checkSkeleton", () => {
  it("takes a model whose joints rest where the file says, a quaternion's sign apart", () => {
    const nodes = arm();
    nodes[1]?.quaternion.set(0, -HALF, 0, -HALF);
    expect(() => checkSkeleton(DOCUMENT, nodes)).not.toThrow();
  });

  it("leaves the root's place to the frames", () => {
    const nodes = arm();
    nodes[0]?.position.set(9, 9, 9);
    expect(() => checkSkeleton(DOCUMENT, nodes)).not.toThrow();
  });

  it("names a joint off its place, and by how much", () => {
    const nodes = arm();
    nodes[2]?.position.setX(0.252);
    expect(() => checkSkeleton(DOCUMENT, nodes)).toThrow(/Rig arm: .*wrist rests 2\.0 mm off its place/);
  });

  it("names a joint that rests at another angle", () => {
    const nodes = arm();
    nodes[1]?.quaternion.set(0, 0, 0, 1);
    expect(() => checkSkeleton(DOCUMENT, nodes)).toThrow(/elbow rests at another angle/);
  });

  it("names a joint that hangs elsewhere", () => {
    const nodes = arm();
    const wrist = nodes[2];
    if (wrist !== undefined) nodes[0]?.add(wrist);
    expect(() => checkSkeleton(DOCUMENT, nodes)).toThrow(/wrist hangs from another joint than elbow/);
  });
});
