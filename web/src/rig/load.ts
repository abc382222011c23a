/** Fetch a rig and its model, and bind one to the other by the names of the GLB's nodes. */

import { type Object3D, SkinnedMesh } from "three";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

import type { Tier } from "../scene/tiers";
import { RigError, readRigDocument, type RigDocument } from "./document";
import { checkSkeleton } from "./skeleton-check";

export interface LoadedRig {
  readonly document: RigDocument;
  readonly scene: Object3D;
  /** The GLB's node of each joint, in the rig file's order. */
  readonly joints: readonly Object3D[];
  /** The GLB's node of each part, in the rig file's order. */
  readonly parts: readonly Object3D[];
}

/** Address of a file that a rig links: absolute as it stands, else relative to the rig as a folder. */
export function resolveRigLink(link: string, rigUrl: string, page: string): string {
  const rig = new URL(rigUrl, page);
  const folder = new URL(rig.pathname.replace(/\/?$/, "/"), rig);
  return new URL(link, folder).href;
}

async function fetchOk(url: string, rig: string): Promise<Response> {
  const response = await fetch(url);
  if (!response.ok) throw new RigError(`Rig ${rig}: ${url} answered ${response.status} ${response.statusText}.`);
  return response;
}

/** The Object3D of the GLB's node of this name; by the file's own names, which three.js changes where they repeat. */
async function findNode(gltf: GLTF, name: string): Promise<Object3D | null> {
  const nodes = gltf.parser.json as { nodes?: { name?: string }[] };
  const index = nodes.nodes?.findIndex((node) => node.name === name) ?? -1;
  return index < 0 ? null : ((await gltf.parser.getDependency("node", index)) as Object3D);
}

async function bindNodes(gltf: GLTF, names: readonly string[], rig: string, what: string): Promise<Object3D[]> {
  const found = await Promise.all(names.map((name) => findNode(gltf, name)));
  const missing = names.filter((_, i) => found[i] === null);
  if (missing.length > 0) {
    throw new RigError(`Rig ${rig}: its model has no node for the ${what} ${[...new Set(missing)].join(", ")}.`);
  }
  return found.filter((node) => node !== null);
}

/**
 * Fetch a rig's file and its model for a tier.
 *
 * @param url of the rig's file; its links may be relative to it.
 * @throws RigError if either cannot be had, or if the model's skeleton is not the file's.
 */
export async function loadRig(name: string, url: string, tier: Tier): Promise<LoadedRig> {
  const document = readRigDocument(await (await fetchOk(url, name)).json(), name);
  const modelUrl = resolveRigLink(document.models[tier], url, globalThis.location.href);
  const model = await (await fetchOk(modelUrl, name)).arrayBuffer();
  const gltf = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(model, "");

  const joints = await bindNodes(
    gltf,
    document.joints.map((joint) => joint.node),
    name,
    "joints",
  );
  const parts = await bindNodes(
    gltf,
    document.parts.map((part) => part.node),
    name,
    "parts",
  );
  checkSkeleton(document, joints);
  gltf.scene.traverse((node) => {
    // A skin's bounds are those of its rest pose, which the player leaves.
    if (node instanceof SkinnedMesh) node.frustumCulled = false;
  });
  return { document, scene: gltf.scene, joints, parts };
}
