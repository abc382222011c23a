/** Between the world and the picture on screen: for what is drawn over the stage. */

import { Box3, PerspectiveCamera, Sphere, Vector3 } from "three";

import type { FramedView } from "./camera-presets";
import { ROOM } from "./room/plan";
import { aim, type ShowPose } from "./camera";

/** A place in the world, metres. */
export type Place = readonly [x: number, y: number, z: number];

/** A place on the canvas, CSS pixels from its left and its top. */
export interface PicturePoint {
  readonly x: number;
  readonly y: number;
}

/** Where the show's own camera is, and what it sees. */
export interface ShowCamera {
  readonly position: Place;
  readonly target: Place;
  /** Of its frame, by turns. */
  readonly corners: readonly Place[];
}

const ASPECT = 16 / 9;
/** The player's middle, which an overview always has in it. */
const MIDDLE: Place = [0, 1, 0];
const OVERVIEW = { direction: new Vector3(-0.5, 0.4, 0.76).normalize(), fov: 0.8, nearest: 2.6, furthest: 7 };
/** An overview stands inside of the room, off its walls and its lamps, metres. */
const WITHIN = new Box3(
  new Vector3(1 - ROOM.halfWidth, 0.5, 1 + ROOM.back),
  new Vector3(ROOM.halfWidth - 1, 2.9, ROOM.front - 1),
);

/** What is seen of places of the world through a camera on a canvas of some CSS pixels. */
export class PictureSpace {
  readonly #camera: PerspectiveCamera;
  readonly #size: () => { readonly width: number; readonly height: number };
  readonly #point = new Vector3();
  readonly #other = new PerspectiveCamera();

  constructor(camera: PerspectiveCamera, size: () => { readonly width: number; readonly height: number }) {
    this.#camera = camera;
    this.#size = size;
  }

  /** Where a place is in the picture, inside of the canvas or not; null behind the camera. */
  pointOf([x, y, z]: Place): PicturePoint | null {
    const point = this.#point.set(x, y, z).applyMatrix4(this.#camera.matrixWorldInverse);
    if (point.z > -this.#camera.near) return null;
    point.applyMatrix4(this.#camera.projectionMatrix);
    const { width, height } = this.#size();
    return { x: ((point.x + 1) / 2) * width, y: ((1 - point.y) / 2) * height };
  }

  /** A place moved along the picture by so many pixels; it stays as far from the camera as it was. */
  moved([x, y, z]: Place, right: number, down: number): [number, number, number] {
    const { width, height } = this.#size();
    const point = this.#point.set(x, y, z).project(this.#camera);
    point.x += (2 * right) / width;
    point.y -= (2 * down) / height;
    return point.unproject(this.#camera).toArray();
  }

  /** Where the corners of what another camera sees are, so many metres before it, by turns: for a frame of 16:9. */
  cornersOf(pose: ShowPose, distance: number): Place[] {
    const other = this.#other;
    aim(other, pose);
    other.updateMatrixWorld();
    const up = Math.tan(pose.fov / 2) * distance;
    const right = up * ASPECT;
    return [
      [-right, up],
      [right, up],
      [right, -up],
      [-right, -up],
    ].map(([across = 0, above = 0]) =>
      this.#point.set(across, above, -distance).applyMatrix4(other.matrixWorld).toArray(),
    );
  }
}

/** A view of some places and the player, from above and from the side. */
export function overview(places: readonly Place[]): FramedView {
  const box = new Box3().setFromPoints([MIDDLE, ...places].map((place) => new Vector3(...place)));
  const sphere = box.getBoundingSphere(new Sphere());
  const { direction, fov, nearest, furthest } = OVERVIEW;
  const distance = Math.min(Math.max(sphere.radius / Math.sin(fov / 2), nearest), furthest);
  const position = direction.clone().multiplyScalar(distance).add(sphere.center).clamp(WITHIN.min, WITHIN.max);
  return { position: position.toArray(), target: sphere.center.toArray(), fov };
}
