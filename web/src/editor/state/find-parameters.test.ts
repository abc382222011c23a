import { describe, expect, it } from "vitest";
import type { ShowParameter } from "../../generated/protocol";
import { findParameters } from "./find-parameters";

const parameter = (path: string, documentation = ""): ShowParameter => ({
  path,
  documentation,
  type: "number",
  length: 1,
  unit: "",
  minimum: null,
  maximum: null,
  default: 0,
  choices: [],
  blend: true,
  interpolations: ["linear"],
});

const ALL = [
  parameter("lights/key/intensity", "Rim lights are others. Exposure too."),
  parameter("lights/rim/intensity"),
  parameter("stage/exposure"),
  parameter("camera/fov"),
  parameter("camera/aperture"),
  parameter("camera/focus_distance"),
  parameter("look/style"),
  parameter("stage/bloom/strength", "How much of the primary light spills."),
];
const found = (sought: string): string[] => findParameters(ALL, sought).map(({ path }) => path);

describe("findParameters", () => {
  it("puts what is called so before what only mentions it", () => {
    expect(found("rim intens")[0]).toBe("lights/rim/intensity");
    expect(found("exposure")).toEqual(["stage/exposure", "lights/key/intensity"]);
    expect(found("rim")).toEqual(["lights/rim/intensity", "lights/key/intensity", "stage/bloom/strength"]);
  });

  it("knows what people call things", () => {
    expect(found("zoom")).toEqual(["camera/fov"]);
    expect(found("blur")).toEqual(["camera/aperture"]);
    expect(found("toon")).toEqual(["look/style"]);
    expect(found("glow")[0]).toBe("stage/bloom/strength");
  });

  it("gives all for nothing and nothing for what is not there", () => {
    expect(found("")).toHaveLength(ALL.length);
    expect(found("zoom toon")).toEqual([]);
  });
});
