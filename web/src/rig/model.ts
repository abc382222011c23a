/** A rig's model in the scene: sets its joints, its parts and its morphs from a frame, and nothing else. */

import { Group, Mesh, type Object3D, Quaternion, Vector3 } from "three";

import { LayoutError, floatIndex, parameterPrefix, type ParameterIndex, type SkeletonLayout } from "../scene/frame";
import type { RigContact, RigPart, RigZone } from "./document";
import type { LoadedRig } from "./load";

interface PartBinding {
  readonly node: Object3D;
  readonly index: number;
  readonly part: RigPart;
  readonly restPosition: Vector3;
  readonly restRotation: Quaternion;
  readonly axis: Vector3;
}

interface MorphBinding {
  readonly influences: number[];
  readonly target: number;
  readonly index: number;
}

/** A point that goes along with a node: in the node's frame, metres. */
export interface RigPoint {
  readonly node: Object3D;
  readonly offset: Vector3;
}

const turn = new Quaternion();

/** A part at value 0 stands as in the model, at 1 at the end of its travel or angle; others are shown from a value on. */
function movePart(binding: PartBinding, value: number): void {
  const { node, part, restPosition, restRotation } = binding;
  if ("travel" in part) {
    const [x, y, z] = part.travel;
    node.position.set(restPosition.x + x * value, restPosition.y + y * value, restPosition.z + z * value);
  } else if ("shown_from" in part) {
    node.visible = value >= part.shown_from;
  } else {
    node.quaternion.copy(restRotation).multiply(turn.setFromAxisAngle(binding.axis, part.angle * value));
  }
}

export class RigModel {
  /** What stands in the scene. */
  readonly object = new Group();
  readonly name: string;
  /** Name of its rig. */
  readonly rig: string;
  readonly jointNames: readonly string[];
  readonly #nodes: readonly Object3D[];
  readonly #rotations: number;
  readonly #root: number;
  readonly #parts: PartBinding[] = [];
  readonly #morphs: MorphBinding[] = [];
  readonly #contacts: readonly RigContact[];
  readonly #zones: readonly RigZone[];

  /**
   * @throws LayoutError if the frame has a joint that the rig has not.
   */
  constructor(rig: LoadedRig, layout: SkeletonLayout, parameters: ParameterIndex) {
    this.name = layout.name;
    this.object.name = layout.name;
    this.rig = layout.rig;
    this.object.add(rig.scene);
    this.#contacts = rig.document.contacts;
    this.#zones = rig.document.zones;
    const places = new Map(rig.document.joints.map((joint, i) => [joint.name, i]));
    const missing = layout.joints.filter((joint) => !places.has(joint));
    if (missing.length > 0) {
      throw new LayoutError(
        `Skeleton ${layout.name} has joints that rig ${layout.rig} has not: ${missing.join(", ")}.`,
      );
    }
    this.jointNames = layout.joints;
    this.#nodes = layout.joints.flatMap((joint) => rig.joints[places.get(joint) ?? -1] ?? []);
    this.#rotations = floatIndex(layout.offset);
    this.#root = floatIndex(layout.root_offset);

    const prefix = parameterPrefix(layout.name);
    rig.document.parts.forEach((part, i) => {
      const node = rig.parts[i];
      const index = parameters.find(prefix + part.parameter, 1);
      if (node === undefined || index === null) return;
      const restPosition = node.position.clone();
      const restRotation = node.quaternion.clone();
      const axis = "axis" in part ? new Vector3(...part.axis).normalize() : new Vector3();
      this.#parts.push({ node, index, part, restPosition, restRotation, axis });
    });
    for (const { parameter, target } of rig.document.morphs) {
      const index = parameters.find(prefix + parameter, 1);
      if (index !== null) this.#bindMorph(rig.scene, target, index);
    }
  }

  /** Several meshes may hold a target: the skin, the lashes, the brows. */
  #bindMorph(scene: Object3D, name: string, index: number): void {
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const target = node.morphTargetDictionary?.[name];
      const influences = node.morphTargetInfluences;
      if (target !== undefined && influences !== undefined) this.#morphs.push({ influences, target, index });
    });
  }

  /** Take the pose, the parts and the morphs of a frame. */
  pose(floats: Float32Array): void {
    const nodes = this.#nodes;
    let at = this.#rotations;
    for (const node of nodes) {
      node.quaternion.fromArray(floats, at);
      at += 4;
    }
    nodes[0]?.position.fromArray(floats, this.#root);
    for (const binding of this.#parts) movePart(binding, floats[binding.index] ?? 0);
    for (const { influences, target, index } of this.#morphs) influences[target] = floats[index] ?? 0;
  }

  /**
   * A contact's joint and offset, for what is drawn at it.
   *
   * @returns null where the rig has no contact of that name.
   */
  findContact(name: string): RigPoint | null {
    const contact = this.#contacts.find((each) => each.name === name);
    const node = contact && this.findJoint(contact.joint);
    return contact && node ? { node, offset: new Vector3(...contact.offset) } : null;
  }

  /** Where a piece of a kit is struck first of all; null where the rig has no such piece. */
  findZone(piece: string): RigPoint | null {
    const zone = this.#zones.find((each) => each.piece === piece);
    const node = zone && this.findJoint(zone.joint);
    return zone && node ? { node, offset: new Vector3(...zone.position) } : null;
  }

  /** The node of a joint, or null. */
  findJoint(name: string): Object3D | null {
    return this.#nodes[this.jointNames.indexOf(name)] ?? null;
  }

  /** Read the joints' local rotations back, by name, x y z w. */
  readRotations(into: Record<string, [number, number, number, number]>): void {
    this.jointNames.forEach((joint, i) => {
      const q = this.#nodes[i]?.quaternion;
      if (q === undefined) return;
      into[joint in into ? `${this.name}/${joint}` : joint] = [q.x, q.y, q.z, q.w];
    });
  }
}
