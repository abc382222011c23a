import { describe, expect, it } from "vitest";

import { channelsInWords, hierarchy } from "./hierarchy";

describe("hierarchy", () => {
  it("tells channels in the file's order", () => {
    expect(channelsInWords(["Xposition", "Yposition", "Zposition", "Zrotation", "Xrotation", "Yrotation"])).toBe(
      "pos XYZ · rot ZXY",
    );
    expect(channelsInWords(["Yrotation"])).toBe("rot Y");
    expect(channelsInWords([])).toBe("");
  });

  it("counts how deep a joint hangs", () => {
    const joints = [
      { name: "hips", parent: null, offset: [0, 0, 0] as [number, number, number], channels: [] },
      { name: "spine", parent: 0, offset: [0, 1, 0] as [number, number, number], channels: [] },
      { name: "neck", parent: 1, offset: [0, 1, 0] as [number, number, number], channels: [] },
      { name: "leg", parent: 0, offset: [1, 0, 0] as [number, number, number], channels: [] },
    ];
    expect(hierarchy({ joints }).map((row) => [row.name, row.depth])).toEqual([
      ["hips", 0],
      ["spine", 1],
      ["neck", 2],
      ["leg", 1],
    ]);
  });
});
