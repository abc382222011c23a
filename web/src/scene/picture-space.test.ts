import { PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { PictureSpace } from "./picture-space";

const camera = new PerspectiveCamera(50, 2, 0.05, 60);
camera.position.set(1, 2, 4);
camera.lookAt(0.5, 1, -1);
camera.updateMatrixWorld();
const space = new PictureSpace(camera, () => ({ width: 800, height: 400 }));

describe("the picture's space", () => {
  it("has what is looked at in its middle, and nothing that is behind the camera", () => {
    const middle = space.pointOf([0.5, 1, -1]);
    expect(middle?.x).toBeCloseTo(400, 6);
    expect(middle?.y).toBeCloseTo(200, 6);
    expect(space.pointOf([1.5, 3, 9])).toBeNull();
  });

  it("moves a place by pixels, as far from the camera as it was", () => {
    const moved = space.moved([0.2, 0.7, 0.3], 30, -12);
    const [before, after] = [space.pointOf([0.2, 0.7, 0.3]), space.pointOf(moved)];
    expect((after?.x ?? 0) - (before?.x ?? 0)).toBeCloseTo(30, 6);
    expect((after?.y ?? 0) - (before?.y ?? 0)).toBeCloseTo(-12, 6);
    const depth = (place: readonly [number, number, number]) =>
      new Vector3(...place).applyMatrix4(camera.matrixWorldInverse).z;
    expect(depth(moved)).toBeCloseTo(depth([0.2, 0.7, 0.3]), 9);
  });

  it("knows the corners of what another camera sees", () => {
    const pose = { position: new Vector3(0, 1, 3), target: new Vector3(0, 1, 0), fov: Math.PI / 2, roll: 0 };
    const corners = space.cornersOf(pose, 0.5);
    expect(corners.map((corner) => corner.map((each) => Number(each.toFixed(6))))).toEqual([
      [-0.888889, 1.5, 2.5],
      [0.888889, 1.5, 2.5],
      [0.888889, 0.5, 2.5],
      [-0.888889, 0.5, 2.5],
    ]);
    // Tipped a quarter turn, its upper left corner is where its lower left was.
    const [first] = space.cornersOf({ ...pose, roll: Math.PI / 2 }, 0.5);
    expect(first?.[0]).toBeCloseTo(0.5, 6);
  });
});
