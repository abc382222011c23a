import type { ParsedClip } from "../../generated/lab";
import { clipWords } from "../../words/lab-clips/en";

/** One row of a clip's tree. */
export interface HierarchyRow {
  readonly point: number;
  readonly name: string;
  readonly depth: number;
  /** "position XYZ, rotation ZXY", short. */
  readonly channels: string;
}

/** Channels in the file's order: `["Xposition", "Zrotation"]` is "pos X · rot Z". */
export function channelsInWords(channels: readonly string[]): string {
  const letters = (kind: string): string =>
    channels
      .filter((channel) => channel.toLowerCase().endsWith(kind))
      .map((channel) => channel.charAt(0).toUpperCase())
      .join("");
  const position = letters("position");
  const rotation = letters("rotation");
  return [
    position === "" ? "" : clipWords.position({ axes: position }),
    rotation === "" ? "" : clipWords.rotation({ axes: rotation }),
  ]
    .filter((part) => part !== "")
    .join(" · ");
}

/** A clip's joints, children under their parents in the file's order. End sites are left out. */
export function hierarchy(clip: Pick<ParsedClip, "joints">): HierarchyRow[] {
  const depths: number[] = [];
  return clip.joints.map((joint, point) => {
    const depth = joint.parent === null ? 0 : (depths[joint.parent] ?? 0) + 1;
    depths.push(depth);
    return { point, name: joint.name, depth, channels: channelsInWords(joint.channels) };
  });
}
