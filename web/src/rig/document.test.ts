import { describe, expect, it } from "vitest";

import { readRigDocument, RigError } from "./document";
import { resolveRigLink } from "./load";

const JOINT = { name: "hips", parent: null, translation: [0, 1, 0], rotation: [0, 0, 0, 1], node: "hips" };
const MODELS = { full: "full.glb", medium: "medium.glb", low: "low.glb" };

describe("readRigDocument", () => {
  it("takes what it needs and fills in empty lists", () => {
    const document = readRigDocument({ name: "figure", models: MODELS, joints: [JOINT] }, "figure");
    expect(document.joints[0]?.name).toBe("hips");
    expect([document.parts, document.morphs, document.contacts]).toEqual([[], [], []]);
  });

  it.each([
    ["not a JSON object", []],
    ["it links no models", { joints: [JOINT] }],
    ['it links no "low" model', { models: { ...MODELS, low: undefined }, joints: [JOINT] }],
    ["it has no joints", { models: MODELS }],
    ['"parts" is not a list', { models: MODELS, joints: [JOINT], parts: {} }],
    ["joint hips names no node", { models: MODELS, joints: [{ ...JOINT, node: undefined }] }],
  ])("says that %s", (fault, value) => {
    expect(() => readRigDocument(value, "figure")).toThrow(RigError);
    expect(() => readRigDocument(value, "figure")).toThrow(fault);
  });
});

describe("resolveRigLink", () => {
  const page = "http://localhost:8000/s/abc";

  it("takes a relative link as one below the rig", () => {
    const expected = "http://localhost:8000/api/v1/rigs/trumpet/full.glb";
    expect(resolveRigLink("full.glb", "/api/v1/rigs/trumpet", page)).toBe(expected);
    expect(resolveRigLink("full.glb", "/api/v1/rigs/trumpet/", page)).toBe(expected);
  });

  it("leaves an absolute link as it stands", () => {
    expect(resolveRigLink("/files/full.glb", "/api/v1/rigs/trumpet", page)).toBe(
      "http://localhost:8000/files/full.glb",
    );
  });
});
