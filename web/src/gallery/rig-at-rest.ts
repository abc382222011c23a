/** A rig that no session plays, stood on the stage as its file has it at rest: one skeleton more, and its floats. */

import type { Hello } from "../generated/protocol";
import { HEADER_BYTES, type SkeletonLayout } from "../scene/frame";

/** What is read of a rig's file. */
interface Joints {
  readonly joints: readonly { readonly name: string; readonly rotation: readonly number[] }[];
}

export class RigAtRest {
  readonly layout: SkeletonLayout;
  readonly floats: readonly number[];

  private constructor(layout: SkeletonLayout, floats: readonly number[]) {
    this.layout = layout;
    this.floats = floats;
  }

  /**
   * @param asked its name, and where it stands, metres: `drumkit@0,0.2,-2.15`.
   * @param offset bytes from the frame's start to where its floats are put.
   */
  static async load(asked: string, offset: number): Promise<RigAtRest> {
    const [name = "", place = "0,0,0"] = asked.split("@");
    const answer = await fetch(`/api/v1/rigs/${name}`);
    if (!answer.ok) throw new Error(`The server has no rig ${name}.`);
    const { joints } = (await answer.json()) as Joints;
    const floats = [...joints.flatMap(({ rotation }) => rotation), ...place.split(",").map(Number)];
    const layout = { name, rig: name, player: 0, joints: joints.map((joint) => joint.name) };
    return new RigAtRest({ ...layout, offset, root_offset: offset + 16 * joints.length }, floats);
  }

  /** Rigs one after another behind the frame of a session. */
  static async loadAll(asked: readonly string[], manifest: Hello): Promise<RigAtRest[]> {
    const rigs: RigAtRest[] = [];
    let offset = manifest.frame_size;
    for (const one of asked) {
      const rig = await RigAtRest.load(one, offset);
      offset += 4 * rig.floats.length;
      rigs.push(rig);
    }
    return rigs;
  }
}

/** A frame's floats with those of the rigs behind them. */
export function withRigs(floats: Float32Array, manifest: Hello, rigs: readonly RigAtRest[]): Float32Array {
  const own = (manifest.frame_size - HEADER_BYTES) / 4;
  const all = new Float32Array(own + rigs.reduce((sum, rig) => sum + rig.floats.length, 0));
  all.set(floats.subarray(0, own));
  let at = own;
  for (const rig of rigs) {
    all.set(rig.floats, at);
    at += rig.floats.length;
  }
  return all;
}
