/** A model's skeleton must be its rig file's: the frames are computed on the one and drawn on the other. */

import type { Object3D } from "three";

import { RigError, type RigDocument } from "./document";

/** Metres by which a joint of the model may stand off its place in the file. */
const TRANSLATION_TOLERANCE = 1e-4;
/** Of a rotation's components; a quaternion and its negative are the same. */
const ROTATION_TOLERANCE = 1e-3;

function nearestJoint(node: Object3D | null, joints: ReadonlySet<Object3D>): Object3D | null {
  for (let at = node; at !== null; at = at.parent) {
    if (joints.has(at)) return at;
  }
  return null;
}

/**
 * Compare parents and rest poses.
 *
 * @param joints the model's nodes, in the document's order, in the rest pose.
 * @throws RigError naming every joint that differs and how.
 */
export function checkSkeleton(document: RigDocument, joints: readonly Object3D[]): void {
  const nodes = new Set(joints);
  const byName = new Map(document.joints.map((joint, i) => [joint.name, joints[i]]));
  const faults: string[] = [];
  document.joints.forEach((joint, i) => {
    const node = joints[i];
    if (node === undefined) return;
    const parent = joint.parent === null ? null : (byName.get(joint.parent) ?? null);
    if (nearestJoint(node.parent, nodes) !== parent) {
      faults.push(`${joint.name} hangs from another joint than ${joint.parent ?? "none"}`);
      return;
    }
    if (parent !== null && node.parent !== parent) {
      faults.push(`${joint.name} has nodes between it and ${joint.parent ?? "its parent"}`);
    }
    const [x, y, z] = joint.translation;
    const apart = Math.hypot(node.position.x - x, node.position.y - y, node.position.z - z);
    // The root's place comes with every frame.
    if (parent !== null && apart > TRANSLATION_TOLERANCE) {
      faults.push(`${joint.name} rests ${(apart * 1000).toFixed(1)} mm off its place`);
    }
    const [qx, qy, qz, qw] = joint.rotation;
    const q = node.quaternion;
    if (1 - Math.abs(q.x * qx + q.y * qy + q.z * qz + q.w * qw) > ROTATION_TOLERANCE) {
      faults.push(`${joint.name} rests at another angle`);
    }
  });
  if (faults.length > 0) {
    throw new RigError(`Rig ${document.name}: its model and its file disagree: ${faults.join("; ")}.`);
  }
}
