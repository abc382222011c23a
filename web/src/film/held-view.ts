/** A view that is held through a film: the frame's camera is set to it, whatever the show's does. */

import { HEADER_SIZE, type ParameterManifest } from "../generated/protocol";
import type { CameraView } from "../scene";

/** Set a frame's camera; floats as behind the header. */
export type HoldView = (floats: Float32Array) => void;

/** What holds a view in frames of these parameters. */
export function holdView(parameters: readonly ParameterManifest[], view: CameraView): HoldView {
  const values: Readonly<Record<string, readonly number[]>> = {
    "camera/position": view.position,
    "camera/target": view.target,
    "camera/fov": [view.fov],
    "camera/roll": [view.roll],
  };
  const held = parameters.flatMap(({ path, offset }) => {
    const value = values[path];
    return value === undefined ? [] : [{ index: (offset - HEADER_SIZE) / Float32Array.BYTES_PER_ELEMENT, value }];
  });
  return (floats) => {
    for (const { index, value } of held) floats.set(value, index);
  };
}
