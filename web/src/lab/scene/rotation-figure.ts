/** Four ways over a sphere: paths of the tip, marks at equal steps, and the frames that move along them. */

import {
  BoxGeometry,
  type BufferGeometry,
  ConeGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  OctahedronGeometry,
  SphereGeometry,
} from "three";
import type { Line2 } from "three/addons/lines/Line2.js";

import type { InterpolationComparison } from "../../generated/lab";
import { type MarkerShape, WAYS, type WayName } from "../ways";
import { PAPER } from "./palette";
import { Gizmo, release, setLine, thickLine, thinLines } from "./parts";
import type { Figure } from "./view";

const MARKER = 0.038;
const FRAME = 0.24;
const STEPS = 12;

const SHAPES: Record<MarkerShape, () => BufferGeometry> = {
  ball: () => new SphereGeometry(MARKER, 20, 14),
  cube: () => new BoxGeometry(1.6 * MARKER, 1.6 * MARKER, 1.6 * MARKER),
  diamond: () => new OctahedronGeometry(1.35 * MARKER),
  cone: () => new ConeGeometry(1.1 * MARKER, 2.2 * MARKER, 16),
};

function graticule(): number[] {
  const points: number[] = [];
  const at = (latitude: number, longitude: number): void => {
    const around = Math.cos(latitude);
    points.push(around * Math.cos(longitude), Math.sin(latitude), around * Math.sin(longitude));
  };
  const step = Math.PI / 36;
  for (let i = 0; i < 72; i++) {
    for (let line = -2; line <= 2; line++) {
      at((line * Math.PI) / 6, i * step);
      at((line * Math.PI) / 6, (i + 1) * step);
    }
    if (i < 36)
      for (let line = 0; line < 12; line++) {
        at(-Math.PI / 2 + i * step, (line * Math.PI) / 6);
        at(-Math.PI / 2 + (i + 1) * step, (line * Math.PI) / 6);
      }
  }
  return points;
}

class DrawnWay {
  readonly object = new Group();
  readonly #path: Line2;
  readonly #arm: Line2;
  readonly #gizmo = new Gizmo(2.5);
  readonly #marker: Mesh;
  readonly #steps: InstancedMesh;

  constructor(name: WayName) {
    const { colour, dash, shape } = WAYS[name];
    const material = new MeshBasicMaterial({ color: colour });
    this.#path = thickLine(colour, 3, dash === null ? {} : { dash: [dash[0] / 130, dash[1] / 130] });
    this.#arm = thickLine(colour, 1.5, { opacity: 0.6 });
    this.#marker = new Mesh(SHAPES[shape](), material);
    this.#steps = new InstancedMesh(new SphereGeometry(0.014, 8, 6), material, STEPS + 1);
    this.#steps.frustumCulled = false;
    this.object.add(this.#path, this.#arm, this.#gizmo.object, this.#marker, this.#steps);
  }

  set(tip: readonly (readonly number[])[]): void {
    setLine(this.#path, tip.flat());
    const matrix = new Matrix4();
    for (let step = 0; step <= STEPS; step++) {
      const [x = 0, y = 0, z = 0] = tip[Math.round((step * (tip.length - 1)) / STEPS)] ?? [];
      this.#steps.setMatrixAt(step, matrix.makeTranslation(x, y, z));
    }
    this.#steps.instanceMatrix.needsUpdate = true;
  }

  seek(tip: readonly number[], axes: readonly (readonly number[])[]): void {
    const [x = 0, y = 0, z = 0] = tip;
    this.#marker.position.set(x, y, z);
    this.#gizmo.set(tip, axes, FRAME);
    setLine(this.#arm, [0, 0, 0, x, y, z]);
  }
}

export class RotationFigure implements Figure {
  readonly object = new Group();
  readonly #ways = new Map<WayName, DrawnWay>();
  readonly #ends = [new Gizmo(1.5, 0.55), new Gizmo(1.5, 0.55)];
  #answer: InterpolationComparison | null = null;

  constructor() {
    const glass = new Mesh(
      new SphereGeometry(0.995, 64, 40),
      new MeshStandardMaterial({
        color: "#1d2434",
        roughness: 0.22,
        transparent: true,
        opacity: 0.34,
        depthWrite: false,
      }),
    );
    this.object.add(glass, thinLines(graticule(), PAPER, 0.13), ...this.#ends.map((gizmo) => gizmo.object));
  }

  /** Seen from where the paths are, a little from above. */
  get frame(): Figure["frame"] {
    const tips = this.#answer?.ways.flatMap((way) => way.tip) ?? [];
    const from = [0, 1, 2].map((i) => tips.reduce((sum, tip) => sum + (tip[i] ?? 0), 0) / Math.max(tips.length, 1));
    const level = Math.hypot(from[0] ?? 0, from[2] ?? 0);
    return {
      centre: [0, 0, 0],
      radius: 1.28,
      from: level < 0.05 ? [0.9, 0.6, 1.6] : [from[0] ?? 0, 0.4 * level + 0.3 * (from[1] ?? 0), from[2] ?? 0],
    };
  }

  /** Take over an answer of the server. */
  set(answer: InterpolationComparison): void {
    this.#answer = answer;
    for (const way of answer.ways) {
      let drawn = this.#ways.get(way.name);
      if (drawn === undefined) {
        drawn = new DrawnWay(way.name);
        this.#ways.set(way.name, drawn);
        this.object.add(drawn.object);
      }
      drawn.set(way.tip);
    }
    const axes = answer.ways[0]?.axes ?? [];
    this.#ends[0]?.set([0, 0, 0], axes[0] ?? [], 0.5);
    this.#ends[1]?.set([0, 0, 0], axes.at(-1) ?? [], 0.5);
  }

  /** Move every frame to a sample. */
  seek(sample: number): void {
    for (const way of this.#answer?.ways ?? [])
      this.#ways.get(way.name)?.seek(way.tip[sample] ?? [], way.axes[sample] ?? []);
  }

  showWays(shown: readonly WayName[]): void {
    for (const [name, way] of this.#ways) way.object.visible = shown.includes(name);
  }

  dispose(): void {
    release(this.object);
  }
}
