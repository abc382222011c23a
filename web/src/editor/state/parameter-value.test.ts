import { describe, expect, it } from "vitest";
import type { Manifest, ShowParameter } from "../../generated/protocol";
import { hexOf, shownNumber, typedNumber, valueOnScreen } from "./parameter-value";

const base = { length: 1, unit: "", minimum: null, maximum: null, blend: true, interpolations: [], documentation: "" };
const manifest: Manifest = {
  protocol: "reina.v1",
  fps: 60,
  frame_size: 56,
  skeletons: [],
  parameters: [
    { path: "lights/key/color", type: "color", offset: 24, length: 3, blend: true },
    { path: "blocks/visible", type: "boolean", offset: 36, length: 1, blend: false },
    { path: "blocks/arrangement", type: "choice", offset: 40, length: 1, blend: false },
    { path: "camera/fov", type: "number", offset: 44, length: 1, blend: true },
  ],
};
const floats = new Float32Array([1, 0.2158605, 0, 1, 1, 0.5, 0, 0]);

function parameter(path: string, type: ShowParameter["type"], choices: string[] = []): ShowParameter {
  return { ...base, path, type, default: "rest", choices };
}

describe("valueOnScreen", () => {
  it("reads each type as a show writes it", () => {
    expect(valueOnScreen(manifest, floats, parameter("lights/key/color", "color"))).toBe("#FF8000");
    expect(valueOnScreen(manifest, floats, parameter("blocks/visible", "boolean"))).toBe(true);
    expect(valueOnScreen(manifest, floats, parameter("blocks/arrangement", "choice", ["a", "b"]))).toBe("b");
    expect(valueOnScreen(manifest, floats, parameter("camera/fov", "number"))).toBe(0.5);
  });

  it("gives the default of what is not streamed", () => {
    expect(valueOnScreen(manifest, floats, parameter("stage/fog", "number"))).toBe("rest");
  });
});

describe("values in the editor", () => {
  it("writes colours in hexadecimal, whichever way they come", () => {
    expect(hexOf("#d9a441")).toBe("#D9A441");
    expect(hexOf([0, 1, 0.002])).toBe("#00FF07");
  });

  it("shows angles in degrees", () => {
    expect(shownNumber(Math.PI / 2, "rad")).toBe(90);
    expect(typedNumber(90, "rad")).toBeCloseTo(Math.PI / 2, 12);
    expect(shownNumber(1.5, "m")).toBe(1.5);
  });
});
