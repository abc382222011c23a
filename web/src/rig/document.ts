/** What the page reads of a rig file (`GET /rigs/{name}`): names to bind, never angles to compute. */

import type { Tier } from "../scene/tiers";

export type Vector = readonly [number, number, number];
export type Quaternion = readonly [number, number, number, number];

export interface RigJoint {
  readonly name: string;
  readonly parent: string | null;
  readonly translation: Vector;
  readonly rotation: Quaternion;
  /** Name of the GLB's node that this joint drives. */
  readonly node: string;
}

/** A GLB node that one parameter moves: along `travel`, or by `angle` about `axis`; or that is there from a value on. */
export type RigPart =
  | { readonly node: string; readonly parameter: string; readonly travel: Vector }
  | { readonly node: string; readonly parameter: string; readonly axis: Vector; readonly angle: number }
  | { readonly node: string; readonly parameter: string; readonly shown_from: number };

export interface RigMorph {
  readonly parameter: string;
  readonly target: string;
}

/** A named point of a joint's frame, metres. */
export interface RigContact {
  readonly name: string;
  readonly joint: string;
  readonly offset: Vector;
}

/** Where a piece of a kit is struck: a point of its surface in a joint's frame, metres. */
export interface RigZone {
  readonly piece: string;
  readonly joint: string;
  readonly position: Vector;
}

export interface RigDocument {
  readonly name: string;
  readonly models: Readonly<Record<Tier, string>>;
  readonly joints: readonly RigJoint[];
  readonly contacts: readonly RigContact[];
  readonly zones: readonly RigZone[];
  readonly morphs: readonly RigMorph[];
  readonly parts: readonly RigPart[];
}

/** The rig file and its model disagree, or one of them lacks what the other names. */
export class RigError extends Error {
  override readonly name = "RigError";
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function list(rig: string, document: Record<string, unknown>, key: string): unknown[] {
  const value = document[key] ?? [];
  if (!Array.isArray(value)) throw new RigError(`Rig ${rig}: "${key}" is not a list.`);
  return value;
}

/**
 * Take a rig file's JSON as a document, with empty lists where it has none.
 *
 * @throws RigError naming the first thing that the page needs and does not find.
 */
export function readRigDocument(value: unknown, rig: string): RigDocument {
  if (!isRecord(value)) throw new RigError(`Rig ${rig}: its file is not a JSON object.`);
  const models = value["models"];
  if (!isRecord(models)) throw new RigError(`Rig ${rig}: it links no models.`);
  for (const tier of ["full", "medium", "low"]) {
    if (typeof models[tier] !== "string") throw new RigError(`Rig ${rig}: it links no "${tier}" model.`);
  }
  const joints = list(rig, value, "joints") as RigJoint[];
  if (joints.length === 0) throw new RigError(`Rig ${rig}: it has no joints.`);
  for (const joint of joints) {
    if (typeof joint.node !== "string") throw new RigError(`Rig ${rig}: joint ${joint.name} names no node.`);
  }
  return {
    name: typeof value["name"] === "string" ? value["name"] : rig,
    models: models as unknown as Record<Tier, string>,
    joints,
    contacts: list(rig, value, "contacts") as RigContact[],
    zones: list(rig, value, "zones") as RigZone[],
    morphs: list(rig, value, "morphs") as RigMorph[],
    parts: list(rig, value, "parts") as RigPart[],
  };
}
