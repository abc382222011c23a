import { Box3, Color, Group, InstancedMesh, type Mesh, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { KitPlace } from "./kit-place";
import { createRug } from "./rug";

const LIGHT = { toKey: new Vector3(0, 1, 0), washed: new Color() };

function kitAt(x: number, y: number, z: number, heading: number): Group {
  const kit = new Group();
  kit.position.set(x, y, z);
  kit.rotation.y = heading;
  kit.updateMatrixWorld();
  return kit;
}

describe("the place of a drum kit", () => {
  it("is not there without a kit, and nothing is put away", () => {
    const row = new InstancedMesh(undefined, undefined, 5);
    const place = new KitPlace(LIGHT, [{ mesh: row, without: 2 }]);
    place.set(null);
    place.follow();
    expect(place.object.visible).toBe(false);
    expect(place.object.children).toHaveLength(0);
    expect(row.count).toBe(5);
    expect(place.reach).toBe(0);
  });

  it("goes where the kit is, makes room for it, and leaves with it", () => {
    const row = new InstancedMesh(undefined, undefined, 5);
    const place = new KitPlace(LIGHT, [{ mesh: row, without: 2 }]);
    place.set(kitAt(0.3, 0.2, -2.4, 0.5));
    place.follow();
    expect(place.object.visible).toBe(true);
    expect(place.object.position.toArray()).toEqual([0.3, 0.2, -2.4]);
    expect(place.object.rotation.y).toBeCloseTo(0.5);
    expect(row.count).toBe(2);
    expect(place.reach).toBeGreaterThan(2.4);
    const names = place.object.children.map(({ name }) => name);
    place.set(null);
    expect(place.object.visible).toBe(false);
    expect(row.count).toBe(5);
    place.set(kitAt(0, 0, 0, 0));
    expect(place.object.children.map(({ name }) => name)).toEqual(names);
  });

  it("is the mirror image under a left-handed player's kit", () => {
    const place = new KitPlace(LIGHT, []);
    const extent = (mirrored: boolean): Box3 => {
      place.set(kitAt(0.3, 0.2, -2.4, 0), mirrored);
      place.follow();
      return new Box3().setFromObject(place.object.getObjectByName("kit_platform") as Mesh);
    };
    const [right, left] = [extent(false), extent(true)];
    expect(left.max.x - 0.3).toBeCloseTo(0.3 - right.min.x);
    expect(left.min.x - 0.3).toBeCloseTo(0.3 - right.max.x);
    expect(left.min.z).toBeCloseTo(right.min.z);
    expect(extent(false).max.x).toBeCloseTo(right.max.x);
  });

  it("has its rug above the platform and no more than a few millimetres over the kit's feet", () => {
    const place = new KitPlace(LIGHT, []);
    place.set(kitAt(0, 0, 0, 0));
    const top = (name: string): number => {
      const mesh = place.object.getObjectByName(name) as Mesh;
      return new Box3().setFromObject(mesh).max.y;
    };
    expect(top("kit_rug")).toBeGreaterThan(top("kit_platform"));
    expect(top("kit_rug")).toBeLessThanOrEqual(0.006);
  });
});

describe("the rug", () => {
  it("is the same from left and right but for the border's turns, and has a border", () => {
    const { data, width, height } = createRug(0.9).image as { data: Uint8Array; width: number; height: number };
    const at = (x: number, y: number): number[] => [...data.slice(4 * (y * width + x), 4 * (y * width + x) + 3)];
    expect(data).toHaveLength(4 * width * height);
    expect(at(2, 300)).toEqual(at(width - 3, 300));
    const middle = Array.from({ length: width }, (_, x) => at(x, height >> 1).join());
    expect(new Set(middle).size).toBeGreaterThanOrEqual(4);
  });
});
