/** The few shapes that the lab's figures are made of. */

import {
  BufferAttribute,
  BufferGeometry,
  type ColorRepresentation,
  DoubleSide,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  OctahedronGeometry,
  Quaternion,
  Vector3,
} from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";

import { AXIS_COLOURS, BRASS, PAPER } from "./palette";

export function brass(): MeshStandardMaterial {
  return new MeshStandardMaterial({ color: BRASS, metalness: 0.85, roughness: 0.4, flatShading: true });
}

/** What stands around and is not moved. */
export function matte(): MeshStandardMaterial {
  return new MeshStandardMaterial({ color: "#434c5f", metalness: 0.1, roughness: 0.75, flatShading: true });
}

export function ghost(opacity: number): MeshStandardMaterial {
  return new MeshStandardMaterial({
    color: PAPER,
    metalness: 0,
    roughness: 0.8,
    transparent: true,
    opacity,
    depthWrite: false,
    flatShading: true,
  });
}

/** A bone along +Y from 0 to 1: thickest a sixth of the way, so that one sees which end is the joint. */
function boneGeometry(): BufferGeometry {
  const geometry = new OctahedronGeometry(1, 0);
  const place = geometry.getAttribute("position");
  for (let i = 0; i < place.count; i++) {
    const y = place.getY(i);
    place.setY(i, y > 0.5 ? 1 : y < -0.5 ? 0 : 0.16);
  }
  geometry.computeVertexNormals();
  return geometry;
}

const UP = new Vector3(0, 1, 0);
const from = new Vector3();
const along = new Vector3();
const turn = new Quaternion();
const size = new Vector3();
const matrix = new Matrix4();

/** Many bones, each between two points. */
export class Bones {
  readonly mesh: InstancedMesh<BufferGeometry, Material>;

  constructor(count: number, material: Material) {
    this.mesh = new InstancedMesh(boneGeometry(), material, Math.max(count, 1));
    this.mesh.count = count;
    this.mesh.frustumCulled = false;
  }

  /** Place one bone; its thickness is a part of its length, at least `least`. */
  set(index: number, start: ArrayLike<number>, end: ArrayLike<number>, share: number, least = 0, a = 0, b = 0): void {
    from.set(start[a] ?? 0, start[a + 1] ?? 0, start[a + 2] ?? 0);
    along.set(end[b] ?? 0, end[b + 1] ?? 0, end[b + 2] ?? 0).sub(from);
    const length = along.length();
    if (length > 0) turn.setFromUnitVectors(UP, along.divideScalar(length));
    const thickness = Math.max(length * share, least);
    this.mesh.setMatrixAt(index, matrix.compose(from, turn, size.set(thickness, length, thickness)));
  }

  finish(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}

/** Three axes that may also be skewed or shrunk: a matrix's columns. */
export class Gizmo {
  readonly object = new Group();
  readonly #axes: Line2[];

  constructor(width: number, opacity = 1) {
    this.#axes = (["x", "y", "z"] as const).map((axis) => thickLine(AXIS_COLOURS[axis], width, { opacity }));
    this.object.add(...this.#axes);
  }

  set(origin: readonly number[], columns: readonly (readonly number[])[], length: number): void {
    const [x = 0, y = 0, z = 0] = origin;
    this.#axes.forEach((line, i) => {
      const [dx = 0, dy = 0, dz = 0] = columns[i] ?? [];
      setLine(line, [x, y, z, x + dx * length, y + dy * length, z + dz * length]);
    });
  }
}

export interface LineLook {
  readonly opacity?: number;
  /** Lengths of dash and gap, in the scene's unit. */
  readonly dash?: readonly [number, number];
}

/** A line whose width is in pixels. */
export function thickLine(color: ColorRepresentation, width: number, { opacity = 1, dash }: LineLook = {}): Line2 {
  const material = new LineMaterial({ color, linewidth: width, transparent: opacity < 1, opacity });
  if (dash !== undefined) {
    material.dashed = true;
    [material.dashSize, material.gapSize] = dash;
  }
  const line = new Line2(new LineGeometry(), material);
  line.frustumCulled = false;
  return line;
}

/** Give a thick line its points, flat x y z x y z …. */
export function setLine(line: Line2, points: readonly number[] | Float32Array): void {
  // The number of points may change, and then the buffers must: a new geometry is the documented way.
  line.geometry.dispose();
  line.geometry = new LineGeometry();
  line.geometry.setPositions(points as Float32Array);
  if (line.material.dashed) line.computeLineDistances();
}

/** Thin lines between pairs of points, flat. */
export function thinLines(points: readonly number[], color: ColorRepresentation, opacity: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false }));
}

/** A sector: a fan of directions around an origin, with its rim. */
export class Fan {
  readonly object = new Group();
  readonly #surface: Mesh<BufferGeometry, MeshBasicMaterial>;
  readonly #rim: Line2;
  readonly #needle: Line2;

  constructor(color: ColorRepresentation) {
    const material = new MeshBasicMaterial({
      color,
      transparent: true,
      opacity: 0.16,
      side: DoubleSide,
      depthWrite: false,
    });
    this.#surface = new Mesh(new BufferGeometry(), material);
    this.#surface.frustumCulled = false;
    this.#rim = thickLine(color, 1.5, { opacity: 0.75 });
    this.#needle = thickLine(PAPER, 2.5);
    this.object.add(this.#surface, this.#rim, this.#needle);
  }

  set(
    origin: readonly number[],
    directions: readonly (readonly number[])[],
    present: readonly number[],
    radius: number,
  ): void {
    const at = (direction: readonly number[]): number[] =>
      [0, 1, 2].map((i) => (origin[i] ?? 0) + (direction[i] ?? 0) * radius);
    const rim = directions.flatMap(at);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([...origin, ...rim]), 3));
    geometry.setIndex(directions.slice(1).flatMap((_, i) => [0, i + 1, i + 2]));
    this.#surface.geometry.dispose();
    this.#surface.geometry = geometry;
    setLine(this.#rim, [...origin, ...rim, ...origin]);
    setLine(this.#needle, [...origin, ...at(present)]);
  }
}

interface Disposable {
  dispose(): void;
}

/** Release the geometries and materials below an object. */
export function release(object: Group): void {
  object.traverse((node) => {
    const { geometry, material } = node as { geometry?: Disposable; material?: Disposable };
    geometry?.dispose();
    material?.dispose();
  });
}
