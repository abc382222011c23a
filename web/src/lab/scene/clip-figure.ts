/** A motion clip: bones between the points that the server gave, a floor, and the way of one joint. */

import { GridHelper, Group, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import type { Line2 } from "three/addons/lines/Line2.js";

import type { ParsedClip } from "../../generated/lab";
import { PAPER, RIBBON } from "./palette";
import { Bones, brass, release, setLine, thickLine } from "./parts";
import type { Figure } from "./view";

export class ClipFigure implements Figure {
  readonly object = new Group();
  readonly frame: Figure["frame"];
  readonly #clip: ParsedClip;
  readonly #positions: Float32Array;
  readonly #bones: Bones;
  readonly #ends: readonly (readonly [number, number])[];
  readonly #size: number;
  readonly #way: Line2;
  readonly #mark: Mesh;
  #chosen: number | null = null;

  /** @param positions (frames, points, 3), in the file's unit */
  constructor(clip: ParsedClip, positions: Float32Array) {
    this.#clip = clip;
    this.#positions = positions;
    const { minimum, maximum } = clip;
    const extent = maximum.map((high, i) => high - (minimum[i] ?? 0));
    this.#size = Math.max(...extent, 1e-9);
    const centre = minimum.map((low, i) => low + (extent[i] ?? 0) / 2);
    this.frame = { centre, radius: (Math.hypot(...extent) / 2) * 1.02 || 1, from: [0.7, 0.35, 1.5] };
    this.#ends = clip.point_parents.flatMap((parent, point) => (parent < 0 ? [] : [[parent, point] as const]));
    this.#bones = new Bones(this.#ends.length, brass());
    const floor = new GridHelper(3 * this.#size, 24, PAPER, PAPER);
    floor.material.transparent = true;
    floor.material.opacity = 0.12;
    floor.position.set(centre[0] ?? 0, minimum[1], centre[2] ?? 0);
    this.#way = thickLine(RIBBON, 2);
    this.#way.visible = false;
    this.#mark = new Mesh(new SphereGeometry(0.014 * this.#size, 16, 12), new MeshBasicMaterial({ color: RIBBON }));
    this.#mark.visible = false;
    this.object.add(floor, this.#bones.mesh, this.#way, this.#mark);
    this.seek(0);
  }

  /** Show one of the sampled frames. */
  seek(frame: number): void {
    const points = this.#clip.points.length;
    const begin = frame * points * 3;
    this.#ends.forEach(([parent, point], i) => {
      this.#bones.set(i, this.#positions, this.#positions, 0.1, 0, begin + parent * 3, begin + point * 3);
    });
    this.#bones.finish();
    if (this.#chosen !== null) {
      const at = begin + this.#chosen * 3;
      this.#mark.position.fromArray(this.#positions, at);
    }
  }

  /** Where a point is, in the file's unit. */
  place(frame: number, point: number): readonly number[] {
    const at = (frame * this.#clip.points.length + point) * 3;
    return [...this.#positions.subarray(at, at + 3)];
  }

  /** Draw the way of one point through the whole clip; null hides it. */
  choose(point: number | null, frame: number): void {
    this.#chosen = point;
    this.#way.visible = this.#mark.visible = point !== null;
    if (point !== null) {
      const frames = this.#clip.sampled_frames;
      const step = Math.max(1, Math.floor(frames / 2000));
      const way: number[] = [];
      for (let i = 0; i < frames; i += step) way.push(...this.place(i, point));
      setLine(this.#way, way.length > 3 ? way : [...way, ...way]);
    }
    this.seek(frame);
  }

  dispose(): void {
    release(this.object);
  }
}
