/** Views of the player that a person can go to, each framed for 16:9. */

import { Vector3 } from "three";

export interface CameraPreset extends FramedView {
  readonly name: "whole_figure" | "three_quarter" | "valves" | "face" | "player" | "hall";
}

/** Where a camera stands for a picture of 16:9. */
export interface FramedView {
  /** In the world, metres. */
  readonly position: readonly [number, number, number];
  readonly target: readonly [number, number, number];
  /** Vertical for 16:9, radians. */
  readonly fov: number;
}

/** The view of the valves, which a small picture over the stage shows too. */
export const VALVES: CameraPreset = {
  name: "valves",
  position: [-0.86, 1.74, 1.02],
  target: [0.02, 1.46, 0.36],
  fov: 0.36,
};

/** Lenses on a full frame: 35 mm has 0.56 rad, 50 has 0.40, 85 has 0.24. */
export const CAMERA_PRESETS: readonly CameraPreset[] = [
  { name: "whole_figure", position: [-1.75, 1.3, 4.3], target: [0.3, 0.93, 0.2], fov: 0.43 },
  { name: "three_quarter", position: [-1.62, 1.56, 2.4], target: [0.06, 1.29, 0.28], fov: 0.5 },
  VALVES,
  { name: "face", position: [-1.0, 1.52, 1.62], target: [0.06, 1.5, 0.2], fov: 0.22 },
  { name: "player", position: [-0.035, 1.575, 0.13], target: [0.05, 1.42, 0.62], fov: 1.0 },
  { name: "hall", position: [-2.7, 1.6, 5.2], target: [0.45, 1.3, 0.2], fov: 0.58 },
];

/** A camera's stand, as a show's camera keys hold it. */
export interface CameraView {
  readonly position: [number, number, number];
  readonly target: [number, number, number];
  readonly fov: number;
  readonly roll: number;
}

/** @returns the preset of that name, or null. */
export function findPreset(name: string): CameraPreset | null {
  return CAMERA_PRESETS.find((preset) => preset.name === name) ?? null;
}

/** The point that a camera looks at, as far ahead as `about` is. */
export function lookedAt(position: Vector3, ahead: Vector3, about: Vector3): Vector3 {
  const distance = Math.max(0.25, new Vector3().subVectors(about, position).dot(ahead));
  return ahead.clone().multiplyScalar(distance).add(position);
}
