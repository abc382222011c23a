import { expect, it } from "vitest";

import type { ParameterManifest } from "../generated/protocol";
import { holdView } from "./held-view";

const parameter = (path: string, offset: number, length: number): ParameterManifest => ({
  path,
  type: length === 3 ? "vector" : "number",
  offset,
  length,
  blend: true,
});

it("sets the camera and nothing else", () => {
  const parameters = [
    parameter("camera/fov", 32, 1),
    parameter("stage/exposure", 36, 1),
    parameter("camera/position", 40, 3),
    parameter("camera/target", 52, 3),
    parameter("camera/roll", 64, 1),
  ];
  const floats = new Float32Array(11).fill(9);
  holdView(parameters, { position: [1, 2, 3], target: [4, 5, 6], fov: 0.5, roll: 0.25 })(floats);
  expect([...floats]).toEqual([9, 9, 0.5, 9, 1, 2, 3, 4, 5, 6, 0.25]);
});

it("leaves alone what a session does not stream", () => {
  const floats = new Float32Array(2).fill(9);
  holdView([parameter("stage/exposure", 24, 1)], { position: [1, 2, 3], target: [4, 5, 6], fov: 0.5, roll: 0 })(floats);
  expect([...floats]).toEqual([9, 9]);
});
