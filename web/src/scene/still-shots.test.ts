import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import type { ShowPose } from "./camera";
import { StillShots } from "./still-shots";

/** The x that is drawn of a camera that stands at x, at a moment. */
function drawn(still: StillShots, x: number, songTime: number, cuts: number, epoch = 0): number {
  const pose: ShowPose = { position: new Vector3(x, 1, 3), target: new Vector3(x, 1, 0), fov: 0.5, roll: 0 };
  still.still(pose, { songTime, epoch, cuts });
  return pose.position.x;
}

describe("StillShots", () => {
  it("holds a drive where its shot began, and takes the next at its cut", () => {
    const still = new StillShots();
    const seen = [0, 1, 2, 3].map((frame) => drawn(still, frame * 0.02, frame / 60, 0));
    expect(seen).toEqual([0, 0, 0, 0]);
    expect(drawn(still, 1.5, 4 / 60, 1)).toBe(1.5);
    expect(drawn(still, 1.52, 5 / 60, 1)).toBe(1.5);
  });

  it("takes no light's cut for the camera's, at any rate of pictures", () => {
    const still = new StillShots();
    drawn(still, 0, 0, 0);
    drawn(still, 0.5, 0.5, 0);
    expect(drawn(still, 0.9, 0.9, 1)).toBe(0);
    expect(drawn(still, 2.9, 1.3, 2)).toBe(2.9);
  });

  it("begins anew after a seek or an edit of the camera, and goes on through play and pause", () => {
    const still = new StillShots();
    drawn(still, 0, 0, 0);
    expect(drawn(still, 0.3, 8, 0, 1)).toBe(0.3);
    expect(drawn(still, 0.35, 8.1, 0, 1)).toBe(0.3);
    expect(drawn(still, 0.36, 8.12, 0, 2)).toBe(0.3);
    expect(drawn(still, 0.8, 8.12, 0, 3)).toBe(0.8);
  });
});
