import type { InterpolationWay } from "../generated/lab";
import { BRASS, DUSK, PAPER, RIBBON } from "./scene/palette";
import { rotationWords as words } from "../words/lab-rotations/en";

export type WayName = InterpolationWay["name"];
export type MarkerShape = "ball" | "cube" | "diamond" | "cone";

export interface WayLook {
  readonly colour: string;
  /** Dash and gap, pixels in plots; none is a whole line. */
  readonly dash: readonly [number, number] | null;
  readonly shape: MarkerShape;
}

/** How each way is drawn, in space and in plots alike: never by colour alone. */
export const WAYS: Record<WayName, WayLook> = {
  slerp: { colour: BRASS, dash: null, shape: "ball" },
  matrix: {
    colour: PAPER,
    dash: [2, 3],
    shape: "cube",
  },
  euler: {
    colour: RIBBON,
    dash: [8, 4],
    shape: "diamond",
  },
  rotation_vector: {
    colour: DUSK,
    dash: [12, 3],
    shape: "cone",
  },
};

/** What a way is called. */
export function wayName(way: WayName): string {
  return words[way];
}

/** What is to be known of a way. */
export function wayMeans(way: WayName): string {
  return words[`${way}_says`];
}
