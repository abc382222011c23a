import { describe, expect, it } from "vitest";

import { LANE } from "./lane";
import { arrangeLanes } from "./lane-arrangement";

/** Places across the stage of the seats that so many take by themselves, in the cast's order. */
const SEATS = [
  [-0.62, 0.62],
  [0, -1.55, 1.55],
  [-0.62, 0.62, -1.55, 1.55],
];

describe("arrangeLanes", () => {
  it("leaves one player's lane where it was", () => {
    expect(arrangeLanes([0.3])).toEqual({ scale: 1, heights: [LANE.bell.height], shifts: [0] });
  });

  it.each(SEATS.map((places) => [places.length, places] as const))(
    "keeps the staves of %i players apart, and above the floor",
    (_, places) => {
      const { scale, heights, shifts } = arrangeLanes(places);
      const staff = 8 * LANE.step * scale;
      for (const ways of [heights, shifts]) {
        const sorted = [...ways].sort((a, b) => a - b);
        for (let i = 1; i < sorted.length; i++)
          expect((sorted[i] ?? 0) - (sorted[i - 1] ?? 0)).toBeGreaterThan(staff + 0.05);
      }
      expect(Math.min(...heights) - staff / 2).toBeGreaterThan(0.3);
      expect(LANE.below.height + Math.cos(LANE.below.lean) * (Math.min(...shifts) - staff / 2)).toBeGreaterThan(-0.25);
    },
  );

  it.each(SEATS.map((places) => [places.length, places] as const))(
    "leads a ribbon of %i past those to its right below theirs, and lays the first player's staff on top of the desk",
    (_, places) => {
      const { heights, shifts } = arrangeLanes(places);
      const byPlace = places.map((place, i) => [place, heights[i] ?? 0] as const).sort(([a], [b]) => a - b);
      expect(byPlace.map(([, height]) => height)).toEqual([...heights].sort((a, b) => a - b));
      expect(shifts).toEqual([...shifts].sort((a, b) => b - a));
    },
  );

  it("leads the lane to a kit over the heads of those before it, and leaves theirs as they are", () => {
    const alone = arrangeLanes([-0.62, 0.62]);
    const { heights } = arrangeLanes([-0.62, 0.62, 0], [false, false, true]);
    expect(heights[1]).toBe(alone.heights[1]);
    expect(heights[2]).toBeGreaterThan(1.7 + 4 * LANE.step);
    expect(arrangeLanes([0, 0], [false, true]).heights[0]).toBe(LANE.bell.height);
    const [first, second] = arrangeLanes([0, 0], [true, true]).heights;
    expect((first ?? 0) - (second ?? 0)).toBeLessThan(-8 * LANE.step);
  });

  it("gives each a lane of its own even at the same place", () => {
    expect(new Set(arrangeLanes([0, 0, 0]).heights).size).toBe(3);
  });
});
