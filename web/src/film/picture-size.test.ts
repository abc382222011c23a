import { expect, it } from "vitest";

import { HEIGHTS, pictureSize } from "./picture-size";

it.each([
  ["16:9", 720, 1280, 720],
  ["16:9", 1080, 1920, 1080],
  ["16:9", 1440, 2560, 1440],
  ["16:9", 2160, 3840, 2160],
  ["1:1", 1080, 1080, 1080],
  ["9:16", 720, 720, 1280],
  ["9:16", 2160, 2160, 3840],
  ["16:9", 144, 256, 144],
  ["16:9", 150, 266, 150],
] as const)("%s at %i is %i × %i", (aspect, height, width, high) => {
  expect(pictureSize(aspect, height)).toEqual({ width, height: high });
});

it("has even sides", () => {
  for (let height = 144; height <= 2160; height += 2) {
    for (const aspect of ["16:9", "1:1", "9:16"] as const) {
      const size = pictureSize(aspect, height);
      expect([size.width % 2, size.height % 2]).toEqual([0, 0]);
    }
  }
  expect(HEIGHTS.map(({ height }) => height)).toEqual([720, 1080, 1440, 2160]);
});
