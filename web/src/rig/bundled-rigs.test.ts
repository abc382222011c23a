import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

import { describe, expect, it } from "vitest";

import { readRigDocument } from "./document";

const RIGS = fileURLToPath(new URL("../../../rigs/", import.meta.url));
const TIERS = ["full", "medium", "low"] as const;

interface Gltf {
  readonly nodes: readonly { readonly name?: string; readonly children?: readonly number[] }[];
  readonly meshes: readonly { readonly extras?: { readonly targetNames?: readonly string[] } }[];
}

/** The JSON chunk of a GLB. */
function readGlb(path: string): Gltf {
  const bytes = readFileSync(path);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString("utf8")) as Gltf;
}

const names = readdirSync(RIGS, { withFileTypes: true })
  .filter((entry) => entry.isDirectory() && entry.name !== "build")
  .map((entry) => entry.name);

describe.each(names)("rig %s", (name) => {
  const document = readRigDocument(JSON.parse(readFileSync(`${RIGS}${name}/rig.json`, "utf8")), name);

  it.each(TIERS)("has every node and morph target that it names in its %s model", (tier) => {
    const { nodes, meshes } = readGlb(`${RIGS}${name}/${document.models[tier]}`);
    const nodeNames = new Set(nodes.map((node) => node.name));
    for (const { node } of [...document.joints, ...document.parts]) expect(nodeNames).toContain(node);
    const targets = new Set(meshes.flatMap((mesh) => mesh.extras?.targetNames ?? []));
    for (const { target } of document.morphs) expect(targets).toContain(target);
  });

  it.each(TIERS)("hangs its joints as the %s model does", (tier) => {
    const { nodes } = readGlb(`${RIGS}${name}/${document.models[tier]}`);
    const parents = new Map(
      nodes.flatMap((node) => (node.children ?? []).map((child) => [nodes[child]?.name, node.name] as const)),
    );
    const nodeOf = new Map(document.joints.map((joint) => [joint.name, joint.node]));
    for (const joint of document.joints) {
      if (joint.parent !== null) expect(parents.get(joint.node)).toBe(nodeOf.get(joint.parent));
    }
  });
});
