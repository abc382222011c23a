import {
  Bone,
  BoxGeometry,
  Group,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  Skeleton,
  SkinnedMesh,
  Uint8BufferAttribute,
  Vector3,
} from "three";
import { describe, expect, it } from "vitest";

import type { RigDocument } from "./document";
import type { LoadedRig } from "./load";
import { mergeMeshes, SHADOW_ELSEWHERE } from "./merge-meshes";

const brass = new MeshStandardMaterial({ name: "brass" });
const silver = new MeshStandardMaterial({ name: "silver" });

function box(name: string, material: MeshStandardMaterial, at = 0): Mesh {
  const mesh = new Mesh(new BoxGeometry(), material);
  mesh.name = name;
  mesh.position.x = at;
  return mesh;
}

/** An instrument of two materials, with a valve that moves and a mute that is shown and hidden. */
function instrument(): LoadedRig {
  const scene = new Group();
  const body = box("body", brass);
  const valve = new Group();
  valve.name = "valve1";
  valve.position.y = 2;
  valve.add(box("cap", brass), box("stem", silver));
  body.add(valve, box("mouthpiece", silver, 3));
  const mute = box("mute", silver, 5);
  scene.add(body, mute);
  const parts = [{ parameter: "valve/1" }, { parameter: "mute", shown_from: 0.5 }];
  return { document: { parts } as unknown as RigDocument, scene, joints: [body], parts: [valve, mute] };
}

/** A body of three cloths of two materials, and a face. */
function figure(): LoadedRig {
  const scene = new Group();
  const bone = new Bone();
  const skeleton = new Skeleton([bone], [new Matrix4()]);
  scene.add(bone);
  for (const [name, material] of [
    ["shirt", brass],
    ["collar", brass],
    ["shoes", silver],
    ["skin", silver],
  ] as const) {
    const geometry = new BoxGeometry();
    const count = geometry.getAttribute("position").count;
    geometry.setAttribute("skinIndex", new Uint8BufferAttribute(new Uint8Array(4 * count), 4));
    const weights = Uint8Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? 255 : 0));
    geometry.setAttribute("skinWeight", new Uint8BufferAttribute(weights, 4, true));
    if (name === "skin") geometry.morphAttributes.position = [geometry.getAttribute("position").clone()];
    const mesh = new SkinnedMesh(geometry, material);
    mesh.name = name;
    mesh.bind(skeleton, new Matrix4());
    scene.add(mesh);
  }
  return { document: { parts: [] } as unknown as RigDocument, scene, joints: [bone], parts: [] };
}

function meshes(scene: Object3D): Mesh[] {
  const found: Mesh[] = [];
  scene.traverse((node) => {
    if (node instanceof Mesh) found.push(node as Mesh);
  });
  return found;
}

/** Where all corners are seen, in the world, sorted. */
function corners(scene: Object3D): string[] {
  scene.updateMatrixWorld(true);
  return meshes(scene)
    .flatMap((mesh) => {
      if (mesh instanceof SkinnedMesh) (mesh as SkinnedMesh).skeleton.update();
      const { index, drawRange } = mesh.geometry;
      const shown = Math.min(index?.count ?? 0, drawRange.count);
      return Array.from({ length: shown }, (_, i) => {
        const corner = mesh.getVertexPosition(index?.getX(i) ?? i, new Vector3()).applyMatrix4(mesh.matrixWorld);
        return corner
          .toArray()
          .map((part) => part.toFixed(4))
          .join(" ");
      });
    })
    .sort();
}

describe("mergeMeshes", () => {
  it("draws the same corners with a mesh a material, and what is shown and hidden apart", () => {
    const before = corners(instrument().scene);
    const merged = mergeMeshes(instrument(), false);
    expect(
      meshes(merged.scene)
        .map(({ name }) => name)
        .sort(),
    ).toEqual(["body cap", "mute", "stem mouthpiece"]);
    expect(corners(merged.scene)).toEqual(before);
  });

  it("still moves what moves, and the whole with its joint", () => {
    const [plain, merged] = [instrument(), mergeMeshes(instrument(), false)];
    for (const rig of [plain, merged]) {
      rig.parts[0]?.position.set(0, 1.5, 0);
      rig.joints[0]?.position.set(1, 2, 3);
      rig.joints[0]?.quaternion.set(0, Math.SQRT1_2, 0, Math.SQRT1_2);
    }
    expect(corners(merged.scene)).toEqual(corners(plain.scene));
    expect(merged.joints[0]?.name).toBe("body");
  });

  it("turns the triangles of what is mirrored round, so that its outside stays outside", () => {
    const mirrored = (): LoadedRig => {
      const rig = instrument();
      for (const mesh of meshes(rig.scene)) if (mesh.name === "cap") mesh.scale.x = -1;
      return rig;
    };
    const before = corners(mirrored().scene);
    const { scene } = mergeMeshes(mirrored(), false);
    expect(corners(scene)).toEqual(before);
    const found = meshes(scene).find(({ name }) => name === "body cap");
    if (!(found instanceof SkinnedMesh)) throw new Error("not merged");
    const merged = found as SkinnedMesh;
    scene.updateMatrixWorld(true);
    merged.skeleton.update();
    const { index } = merged.geometry;
    const at = (i: number): Vector3 => merged.getVertexPosition(index?.getX(i) ?? i, new Vector3());
    for (const [first, middle] of [
      [0, new Vector3()],
      [36, new Vector3(0, 2, 0)],
    ] as const) {
      for (let i = first; i < first + 36; i += 3) {
        const [a, b, c] = [at(i), at(i + 1), at(i + 2)];
        const out = b.clone().sub(a).cross(c.clone().sub(a));
        expect(out.dot(a.clone().sub(middle))).toBeGreaterThan(0);
      }
    }
  });

  it("merges cloth of one material, and leaves faces alone", () => {
    const before = corners(figure().scene);
    const merged = mergeMeshes(figure(), false);
    expect(
      meshes(merged.scene)
        .map(({ name }) => name)
        .sort(),
    ).toEqual(["shirt collar", "shoes", "skin"]);
    expect(corners(merged.scene)).toEqual(before);
  });

  it("lets one mesh of a body cast the whole shadow, and shows of it what it showed", () => {
    const before = corners(figure().scene);
    const { scene } = mergeMeshes(figure(), true);
    expect(corners(scene)).toEqual(before);
    const [caster, ...others] = meshes(scene).sort(
      (a, b) => Number(SHADOW_ELSEWHERE in a.userData) - Number(SHADOW_ELSEWHERE in b.userData),
    );
    expect(others.every(({ userData }) => userData[SHADOW_ELSEWHERE] === true)).toBe(true);
    expect(caster?.userData).toEqual({});
    const shadow = caster as unknown as { onBeforeShadow(): void; onAfterShadow(): void };
    shadow.onBeforeShadow();
    const shaded = Math.min(caster?.geometry.drawRange.count ?? 0, caster?.geometry.index?.count ?? 0);
    expect(shaded).toBe(4 * 36);
    shadow.onAfterShadow();
    expect(caster?.geometry.drawRange.count).toBe(2 * 36);
  });
});
