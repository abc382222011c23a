/** A model drawn in fewer calls, for the same picture: as many players have to fit on a stage. */

import {
  Bone,
  BufferAttribute,
  BufferGeometry,
  type Material,
  Matrix4,
  Mesh,
  type Object3D,
  Skeleton,
  SkinnedMesh,
  type TypedArray,
} from "three";

import type { LoadedRig } from "./load";

/** Key of `userData` of what casts its shadow as a piece of another mesh. */
export const SHADOW_ELSEWHERE = "shadowElsewhere";

const SKIN = ["skinIndex", "skinWeight"] as const;

interface Piece {
  readonly geometry: BufferGeometry;
  /** The bone that moves all of it; null where its own skin says which. */
  readonly bone: number | null;
  /** It is drawn as its mirror image, and so its triangles turn round. */
  readonly mirrored?: boolean;
}

/**
 * Make one mesh of those that share a material, and one shadow of those that share a skeleton.
 *
 * Pieces that move by themselves, as valves do, become a skin whose bones they are. What has morph targets, or is shown
 * and hidden, stays apart.
 *
 * @param shadows whether they are cast at all.
 */
export function mergeMeshes(rig: LoadedRig, shadows: boolean): LoadedRig {
  const { scene, document } = rig;
  const apart = new Set(rig.parts.filter((_, i) => "shown_from" in (document.parts[i] ?? {})));
  const replaced = mergeByMaterial(scene, collect(scene, apart));
  if (shadows) castTogether(scene);
  const now = (node: Object3D): Object3D => replaced.get(node) ?? node;
  return { document, scene, joints: rig.joints.map(now), parts: rig.parts.map(now) };
}

/** Meshes that can be merged, in lists of those that can be merged with one another. */
function collect(scene: Object3D, apart: ReadonlySet<Object3D>): Mesh[][] {
  const lists = new Map<string, Mesh[]>();
  const visit = (node: Object3D): void => {
    if (apart.has(node)) return;
    if (node instanceof Mesh && !Array.isArray(node.material) && node.morphTargetInfluences === undefined) {
      const mesh = node as Mesh<BufferGeometry, Material>;
      const moved = mesh instanceof SkinnedMesh ? mesh.skeleton.uuid : "by itself";
      const key = [mesh.material.uuid, moved, ...Object.keys(mesh.geometry.attributes).sort()].join(" ");
      lists.set(key, [...(lists.get(key) ?? []), mesh]);
    }
    node.children.forEach(visit);
  };
  visit(scene);
  return [...lists.values()].filter((meshes) => meshes.length > 1);
}

/** @returns what stands in place of nodes that were meshes themselves. */
function mergeByMaterial(scene: Object3D, lists: readonly Mesh[][]): Map<Object3D, Object3D> {
  const replaced = new Map<Object3D, Object3D>();
  const bones: Bone[] = [];
  const single: { mesh: SkinnedMesh; own: boolean }[] = [];
  scene.updateMatrixWorld(true);
  for (const meshes of lists) {
    const [first] = meshes;
    if (first === undefined) continue;
    const skinned = first instanceof SkinnedMesh;
    const pieces = meshes.map((mesh): Piece => {
      const mirrored = mesh.matrixWorld.determinant() < 0;
      const node = replace(mesh);
      replaced.set(mesh, node);
      return { geometry: mesh.geometry, bone: skinned ? null : bones.push(node) - 1, mirrored };
    });
    const names = [...Object.keys(first.geometry.attributes), ...(skinned ? [] : SKIN)];
    const mesh = new SkinnedMesh(join(first.geometry, pieces, names), first.material);
    mesh.name = meshes.map(({ name }) => name).join(" ");
    mesh.frustumCulled = false;
    if (skinned) mesh.bind(first.skeleton, first.bindMatrix);
    single.push({ mesh, own: !skinned });
    for (const { geometry } of pieces) geometry.dispose();
    scene.add(mesh);
  }
  // Each bone's space is its piece's own: nothing is to be undone before it is moved.
  const skeleton = new Skeleton(
    bones,
    bones.map(() => new Matrix4()),
  );
  for (const { mesh, own } of single) if (own) mesh.bind(skeleton, new Matrix4());
  return replaced;
}

/** Put a bone where a mesh was, with its name, its place and its children. */
function replace(mesh: Mesh): Bone {
  const node = new Bone();
  node.name = mesh.name;
  node.position.copy(mesh.position);
  node.quaternion.copy(mesh.quaternion);
  node.scale.copy(mesh.scale);
  for (const child of [...mesh.children]) node.add(child);
  mesh.parent?.add(node);
  mesh.removeFromParent();
  return node;
}

/** Let one mesh of each skeleton cast the shadow of all: their pieces lie behind its own, and are drawn in shadow only. */
function castTogether(scene: Object3D): void {
  const bySkeleton = new Map<Skeleton, SkinnedMesh[]>();
  scene.traverse((node) => {
    if (!(node instanceof SkinnedMesh)) return;
    const mesh = node as SkinnedMesh;
    bySkeleton.set(mesh.skeleton, [...(bySkeleton.get(mesh.skeleton) ?? []), mesh]);
  });
  for (const meshes of bySkeleton.values()) {
    const [caster, ...others] = meshes.sort((a, b) => rank(b) - rank(a));
    if (caster === undefined || others.length === 0 || caster.morphTargetInfluences !== undefined) continue;
    const own = caster.geometry;
    const pieces = [caster, ...others].map(({ geometry }): Piece => ({ geometry, bone: null }));
    const shown = count(own);
    const whole = join(own, pieces, Object.keys(own.attributes));
    whole.setDrawRange(0, shown);
    caster.geometry = whole;
    caster.onBeforeShadow = () => whole.setDrawRange(0, Number.POSITIVE_INFINITY);
    caster.onAfterShadow = () => whole.setDrawRange(0, shown);
    for (const other of others) other.userData[SHADOW_ELSEWHERE] = true;
    own.dispose();
  }
}

/** What morphs cannot lend its geometry; of the rest the largest needs the fewest copies. */
function rank({ geometry, morphTargetInfluences }: SkinnedMesh): number {
  return morphTargetInfluences === undefined ? count(geometry) : 0;
}

function count({ index, attributes }: BufferGeometry): number {
  return index?.count ?? attributes["position"]?.count ?? 0;
}

/** One geometry of several; an attribute that a piece has not is 0 there. The kinds of numbers are the model's. */
function join(model: BufferGeometry, pieces: readonly Piece[], names: readonly string[]): BufferGeometry {
  const whole = new BufferGeometry();
  const vertices = pieces.reduce((sum, { geometry }) => sum + (geometry.attributes["position"]?.count ?? 0), 0);
  for (const name of names) {
    const like = model.attributes[name];
    const size = like?.itemSize ?? 4;
    const array = (like?.array ?? new Uint8Array()).constructor as new (length: number) => TypedArray;
    const joined = new BufferAttribute(new array(vertices * size), size, like?.normalized ?? name === "skinWeight");
    let at = 0;
    for (const { geometry, bone } of pieces) {
      const piece = geometry.attributes[name];
      const length = geometry.attributes["position"]?.count ?? 0;
      for (let vertex = 0; vertex < length; vertex++, at++) {
        if (bone !== null && isSkin(name)) joined.setX(at, name === "skinIndex" ? bone : 1);
        else if (piece !== undefined) {
          for (let part = 0; part < size; part++) joined.setComponent(at, part, piece.getComponent(vertex, part));
        }
      }
    }
    whole.setAttribute(name, joined);
  }
  const index: number[] = [];
  let first = 0;
  for (const { geometry, mirrored = false } of pieces) {
    const length = geometry.attributes["position"]?.count ?? 0;
    for (let i = 0; i < count(geometry); i++) {
      const corner = mirrored ? i - (i % 3) + ((3 - (i % 3)) % 3) : i;
      index.push(first + (geometry.index?.getX(corner) ?? corner));
    }
    first += length;
  }
  whole.setIndex(index);
  return whole;
}

function isSkin(name: string): boolean {
  return (SKIN as readonly string[]).includes(name);
}
