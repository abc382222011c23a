import type { InterpolationWay } from "../generated/lab";
import { BRASS, DUSK, PAPER, RIBBON } from "./scene/palette";

export type WayName = InterpolationWay["name"];
export type MarkerShape = "ball" | "cube" | "diamond" | "cone";

export interface WayLook {
  readonly label: string;
  readonly colour: string;
  /** Dash and gap, pixels in plots; none is a whole line. */
  readonly dash: readonly [number, number] | null;
  readonly shape: MarkerShape;
  readonly says: string;
}

/** How each way is drawn, in space and in plots alike: never by colour alone. */
export const WAYS: Record<WayName, WayLook> = {
  slerp: { label: "Slerp", colour: BRASS, dash: null, shape: "ball", says: "the shortest way, at one speed" },
  matrix: {
    label: "Matrix",
    colour: PAPER,
    dash: [2, 3],
    shape: "cube",
    says: "leaves the rotations: axes shrink, shear",
  },
  euler: {
    label: "Euler angles",
    colour: RIBBON,
    dash: [8, 4],
    shape: "diamond",
    says: "depends on the order; gimbal lock",
  },
  rotation_vector: {
    label: "Rotation vector",
    colour: DUSK,
    dash: [12, 3],
    shape: "cone",
    says: "bends; may go the long way",
  },
};
