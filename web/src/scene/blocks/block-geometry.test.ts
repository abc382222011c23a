import { type BufferGeometry, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { BLOCK, createBlockGeometry, createCardGeometry, createLineGeometry } from "./block-geometry";

/** A block of a note that is this long, metres: (along, height, thickness) of each vertex. */
function placed(geometry: BufferGeometry, length: number): Vector3[] {
  const position = geometry.getAttribute("position");
  const inset = geometry.getAttribute("inset");
  return Array.from(
    { length: position.count },
    (_, i) => new Vector3(position.getX(i) * length + inset.getX(i), position.getY(i), position.getZ(i)),
  );
}

function triangles(geometry: BufferGeometry): [number, number, number][] {
  const index = [...(geometry.getIndex()?.array ?? [])];
  return Array.from({ length: index.length / 3 }, (_, i) => index.slice(3 * i, 3 * i + 3) as [number, number, number]);
}

describe("createBlockGeometry", () => {
  const geometry = createBlockGeometry(4);
  const points = placed(geometry, 0.3);

  it("fills the block's measures exactly", () => {
    const extent = (axis: "x" | "y" | "z"): number[] => {
      const values = points.map((point) => point[axis]);
      return [Math.min(...values), Math.max(...values)];
    };
    expect(extent("x")[0]).toBeCloseTo(0, 9);
    expect(extent("x")[1]).toBeCloseTo(0.3, 9);
    expect(extent("y")[1]).toBeCloseTo(BLOCK.height / 2, 7);
    expect(extent("z")[0]).toBeCloseTo(-BLOCK.thickness / 2, 7);
  });

  it("is closed: every edge has two sides", () => {
    const edges = new Set<string>();
    for (const [a, b, c] of triangles(geometry)) {
      for (const [from, to] of [
        [a, b],
        [b, c],
        [c, a],
      ] as const)
        edges.add(`${from}-${to}`);
    }
    for (const edge of edges) {
      const [from, to] = edge.split("-");
      expect(edges.has(`${to ?? ""}-${from ?? ""}`)).toBe(true);
    }
  });

  it("faces outward, as its unit normals do", () => {
    const normal = geometry.getAttribute("normal");
    const normals = points.map((_, i) => new Vector3().fromBufferAttribute(normal, i));
    for (const each of normals) expect(each.length()).toBeCloseTo(1, 6);
    for (const corners of triangles(geometry)) {
      const [a, b, c] = corners.map((i) => points[i] ?? new Vector3()) as [Vector3, Vector3, Vector3];
      const face = b.clone().sub(a).cross(c.clone().sub(a));
      if (face.length() < 1e-12) continue;
      const shading = corners.reduce((sum, i) => sum.add(normals[i] ?? new Vector3()), new Vector3());
      expect(face.dot(shading)).toBeGreaterThan(0);
    }
  });
});

describe("cards and lines", () => {
  it("reach one beyond both ends of a note, and half a width to either side of a line", () => {
    const card = createCardGeometry(2).getAttribute("position");
    expect([card.getZ(0), card.getZ(card.count - 1)]).toEqual([-1, 1]);
    const line = createLineGeometry(3).getAttribute("position");
    expect(new Set(Array.from({ length: line.count }, (_, i) => line.getY(i)))).toEqual(new Set([-0.5, 0.5]));
  });
});
