/** The shape of one block, before its note gives it a place and a length. */

import { BufferAttribute, InstancedBufferGeometry } from "three";

/** Metres. */
export const BLOCK = { height: 0.034, thickness: 0.007, edge: 0.0034 } as const;

/** Points of the cross-section's outline: a rectangle with rounded corners, in (height, thickness), with its normals. */
export function outline(corner: number): { v: number; w: number; nv: number; nw: number }[] {
  const points: { v: number; w: number; nv: number; nw: number }[] = [];
  const halfV = BLOCK.height / 2 - BLOCK.edge;
  const halfW = BLOCK.thickness / 2 - BLOCK.edge;
  for (let quarter = 0; quarter < 4; quarter++) {
    const signV = quarter === 0 || quarter === 3 ? 1 : -1;
    const signW = quarter < 2 ? 1 : -1;
    for (let i = 0; i <= corner; i++) {
      const angle = ((quarter + i / corner) * Math.PI) / 2;
      const [nv, nw] = [Math.cos(angle), Math.sin(angle)];
      points.push({ v: signV * halfV + BLOCK.edge * nv, w: signW * halfW + BLOCK.edge * nw, nv, nw });
    }
  }
  return points;
}

/**
 * A rounded bar. `position` holds how far along the note (0…1), then height and thickness in metres; `inset` the metres
 * by which a point stands inside the note's ends; `normal` is (along, height, thickness).
 *
 * @param stations cross-sections between the rounded ends: the lane bends, and the blocks with it.
 */
export function createBlockGeometry(stations: number): InstancedBufferGeometry {
  const section = outline(2);
  const rings = [0, Math.PI / 4, Math.PI / 2].map((angle) => ({
    u: 0,
    inset: BLOCK.edge * (1 - Math.cos(angle)),
    shrink: BLOCK.edge * (1 - Math.sin(angle)),
    tilt: -Math.cos(angle),
  }));
  const end = rings.map((ring) => ({ ...ring, u: 1, inset: -ring.inset, tilt: -ring.tilt })).reverse();
  for (let i = 1; i < stations; i++) rings.push({ u: i / stations, inset: 0, shrink: 0, tilt: 0 });
  rings.push(...end);

  const position: number[] = [];
  const inset: number[] = [];
  const normal: number[] = [];
  const index: number[] = [];
  const add = (u: number, depth: number, v: number, w: number, n: readonly [number, number, number]): void => {
    position.push(u, v, w);
    inset.push(depth);
    normal.push(...n);
  };
  for (const { u, inset: depth, shrink, tilt } of rings) {
    const level = Math.sqrt(1 - tilt * tilt);
    for (const { v, w, nv, nw } of section) {
      add(u, depth, v - nv * shrink, w - nw * shrink, [tilt, nv * level, nw * level]);
    }
  }
  const around = section.length;
  for (let ring = 0; ring + 1 < rings.length; ring++) {
    for (let i = 0; i < around; i++) {
      const a = ring * around + i;
      const b = ring * around + ((i + 1) % around);
      index.push(a, b, a + around, b, b + around, a + around);
    }
  }
  for (const u of [0, 1]) {
    const ring = u * (rings.length - 1);
    const centre = inset.length;
    add(u, 0, 0, 0, [2 * u - 1, 0, 0]);
    for (let i = 0; i < around; i++) {
      const a = ring * around + i;
      const b = ring * around + ((i + 1) % around);
      index.push(...(u === 0 ? [centre, b, a] : [centre, a, b]));
    }
  }
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute("inset", new BufferAttribute(new Float32Array(inset), 1));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normal), 3));
  geometry.setIndex(index);
  return geometry;
}

/**
 * A flat card about a note, for its halo. `position` holds how far along the note (0…1), the height (−1…1) and how far
 * beyond the note's ends (−1, 0 or 1).
 */
export function createCardGeometry(stations: number): InstancedBufferGeometry {
  const columns: [number, number][] = [[0, -1]];
  for (let i = 0; i <= stations; i++) columns.push([i / stations, 0]);
  columns.push([1, 1]);
  return createBand(columns);
}

/** A flat band along a line. `position` holds how far along (0…1) and which edge (±0.5). */
export function createLineGeometry(stations: number): InstancedBufferGeometry {
  const columns = Array.from({ length: stations + 1 }, (_, i): [number, number] => [i / stations, 0]);
  const geometry = createBand(columns);
  geometry.getAttribute("position").array.forEach((value, i, all) => {
    if (i % 3 === 1) all[i] = value / 2;
  });
  return geometry;
}

function createBand(columns: readonly [along: number, beyond: number][]): InstancedBufferGeometry {
  const position = columns.flatMap(([along, beyond]) => [along, -1, beyond, along, 1, beyond]);
  const index = columns.slice(1).flatMap((_, i) => [2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3]);
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
  geometry.setIndex(index);
  return geometry;
}
