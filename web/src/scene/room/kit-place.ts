/** What a drum kit stands on: a platform with a rug, there only while a kit is on the stage. */

import { BoxGeometry, Group, type InstancedMesh, Mesh, type Object3D, Vector3 } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { createContactShade, type Patch } from "./contact-shade";
import type { WithRow } from "./furniture";
import { painted } from "./painted";
import { createRug } from "./rug";
import { createSurface, type RoomLight } from "./surface";

/** The rigs that stand on it: a right-handed player's, and its mirror image. */
export const KIT_RIG = "drumkit";
export const LEFT_HANDED_KIT_RIG = "drumkit_left_handed";

/** In a right-handed player's kit's frame, whose origin is under the stool: to the player's left and right, behind and before, metres. */
const PLATFORM = { left: 0.98, right: -1.42, back: -0.62, front: 1.58 } as const;
const RUG = { left: 0.86, right: -1.3, back: -0.5, front: 1.46 } as const;
const RUG_THICK = 0.003;
/** A platform is a box that goes down to the floor; one that is lower than this would only be seen as an edge. */
const DEEP = 0.6;

/** How far the kit's feet sink into the rug: platform and rug lie over the riser behind and its edge. */
const SUNK = 0.0055;

/** What lies in the kit's shade: the bass drum, the floor tom, the stool, the hi-hat, the snare drum and the stands. */
const SHADE: readonly Patch[] = [
  [-0.19, 0.95, 0.75, 0.6],
  [-0.63, 0.27, 0.7, 0.7],
  [0, 0, 0.62, 0.62],
  [0.4, 0.58, 0.5, 0.5],
  [0.04, 0.4, 0.6, 0.6],
  [-0.19, 0.55, 0.22, 0.44],
  [0.36, 0.42, 0.2, 0.4],
  [0.5, 0.98, 0.5, 0.5],
  [-0.88, 0.7, 0.5, 0.5],
  [-0.7, 1.12, 0.45, 0.45],
  [-1.08, 0.36, 0.45, 0.45],
];

/** Woven: threads across, and a little wear. */
const WEAVE = /* glsl */ `
float weave(vec2 place) {
  vec2 width = fwidth(place);
  float thread = 0.5 + 0.5 * sin(place.x * 1900.0);
  float seen = clamp(0.0016 / max(width.x, 1e-5), 0.0, 1.0);
  float worn = sin(place.x * 7.3 + 1.7 * sin(place.y * 5.1)) * sin(place.y * 6.7 + 1.3 * sin(place.x * 4.3));
  return 1.0 - 0.22 * seen * thread + 0.07 * worn;
}
`;

interface Extent {
  readonly left: number;
  readonly right: number;
  readonly back: number;
  readonly front: number;
}

function slab({ left, right, back, front }: Extent, height: number, top: number): BoxGeometry {
  return new BoxGeometry(left - right, height, front - back).translate(
    (left + right) / 2,
    top - height / 2,
    (front + back) / 2,
  );
}

/** The platform with its rug and what lies in the kit's shade, in the kit's frame. */
function createPlatform(light: RoomLight): Object3D[] {
  const { front, left, right } = PLATFORM;
  const edge = new BoxGeometry(left - right, 0.03, 0.03).translate((left + right) / 2, -0.024, front);
  const wood = createSurface({ vertexColors: true, roughness: 0.55, metalness: 0, envMapIntensity: 0.35 }, light, {});
  const platform = new Mesh(
    mergeGeometries([painted(slab(PLATFORM, DEEP, SUNK - RUG_THICK), 0x38251a), painted(edge, 0x7a5a3c)]),
    wood,
  );
  const picture = createRug((RUG.front - RUG.back) / (RUG.left - RUG.right));
  const cloth = createSurface({ map: picture, roughness: 0.95, metalness: 0, envMapIntensity: 0.25 }, light, {
    declarations: WEAVE,
    color: "diffuseColor.rgb *= weave(vRoomPlace.xz);",
  });
  const rug = new Mesh(slab(RUG, RUG_THICK, SUNK), cloth);
  for (const mesh of [platform, rug]) mesh.receiveShadow = true;
  platform.castShadow = true;
  platform.name = "kit_platform";
  rug.name = "kit_rug";
  const shade = createContactShade(SHADE);
  shade.position.y = SUNK;
  return [platform, rug, shade];
}

/** From under the stool to the outermost of what casts a shadow, as it is seen from the key, metres. */
const KIT_HALF = 0.6;

export class KitPlace {
  readonly object = new Group();
  #node: Object3D | null = null;
  readonly #light: RoomLight;
  readonly #inTheWay: readonly { readonly mesh: InstancedMesh; readonly without: number; readonly all: number }[];
  readonly #scale = new Vector3();

  /** @param inTheWay what of the room is put away while a kit stands there. */
  constructor(light: RoomLight, inTheWay: readonly WithRow[]) {
    this.#light = light;
    this.#inTheWay = inTheWay.map(({ mesh, without }) => ({ mesh, without, all: mesh.count }));
    this.object.name = "kit_place";
    this.object.visible = false;
  }

  /**
   * @param node the kit's root; null where there is none.
   * @param mirrored it is a left-handed player's.
   */
  set(node: Object3D | null, mirrored = false): void {
    this.#node = node;
    if (node !== null && this.object.children.length === 0) this.object.add(...createPlatform(this.#light));
    this.object.visible = node !== null;
    this.object.scale.x = mirrored ? -1 : 1;
    for (const { mesh, without, all } of this.#inTheWay) mesh.count = node === null ? all : without;
  }

  /** Go where the kit is; after the scene's world matrices are up to date. */
  follow(): void {
    if (this.#node === null) return;
    this.#node.matrixWorld.decompose(this.object.position, this.object.quaternion, this.#scale);
    this.object.updateMatrixWorld();
  }

  /** How far what casts a shadow reaches from the room's middle, metres; 0 where there is no kit. */
  get reach(): number {
    if (this.#node === null) return 0;
    const { x, z } = this.object.position;
    return Math.hypot(x, z) + KIT_HALF;
  }
}
