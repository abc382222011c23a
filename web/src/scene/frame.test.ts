import { describe, expect, it } from "vitest";

import { Frame } from "../generated/frame";
import type { Manifest } from "../generated/protocol";
import { floatIndex, HEADER_BYTES, LayoutError, parameterPrefix, ParameterIndex } from "./frame";

/** Two skeletons, their roots, padding, then three parameters. */
const MANIFEST: Manifest = {
  protocol: "reina.v1",
  fps: 60,
  frame_size: 136,
  skeletons: [
    { name: "player", player: 0, rig: "trumpeter", joints: ["hips", "spine"], offset: 24, root_offset: 72 },
    { name: "trumpet", player: 0, rig: "trumpet", joints: ["trumpet"], offset: 56, root_offset: 84 },
  ],
  parameters: [
    { path: "camera/position", type: "vector", offset: 96, length: 3, blend: true },
    { path: "blocks/visible", type: "boolean", offset: 108, length: 1, blend: false },
    { path: "trumpet/valve/1", type: "number", offset: 112, length: 1, blend: true },
  ],
};

describe("floatIndex", () => {
  it("finds the values that the generated reader writes", () => {
    const frame = new Frame(MANIFEST);
    frame.rotations[1]?.set([0.1, 0.2, 0.3, 0.4]);
    frame.rootPositions[1]?.set([5, 6, 7]);
    frame.parameters[2]?.set([0.75]);
    const floats = new Float32Array(frame.words.buffer, HEADER_BYTES);
    expect([...floats.subarray(floatIndex(56), floatIndex(56) + 4)]).toEqual([0.1, 0.2, 0.3, 0.4].map(Math.fround));
    expect([...floats.subarray(floatIndex(84), floatIndex(84) + 3)]).toEqual([5, 6, 7]);
    expect(floats[floatIndex(112)]).toBe(0.75);
  });

  it("refuses offsets in the header and between floats", () => {
    for (const offset of [0, 20, 26, 97]) expect(() => floatIndex(offset)).toThrow(LayoutError);
  });
});

describe("ParameterIndex", () => {
  const parameters = new ParameterIndex(MANIFEST.parameters);

  it("finds a streamed parameter and knows one that is not", () => {
    expect(parameters.find("camera/position", 3)).toBe((96 - 24) / 4);
    expect(parameters.find("camera/roll", 1)).toBeNull();
  });

  it("names a parameter of another length", () => {
    expect(() => parameters.find("camera/position", 1)).toThrow(/camera\/position has 3 floats; the page draws 1/);
  });
});

describe("parameterPrefix", () => {
  it("is empty for the first player and keeps another's number", () => {
    expect(parameterPrefix("player")).toBe("");
    expect(parameterPrefix("trumpet")).toBe("");
    expect(parameterPrefix("players/2/trumpet")).toBe("players/2/");
  });
});
