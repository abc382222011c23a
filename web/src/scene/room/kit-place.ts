/** What a drum kit stands on: a platform with a rug, there only while a kit is on the stage. */

import {
  BoxGeometry,
  CanvasTexture,
  Group,
  type InstancedMesh,
  Mesh,
  type Object3D,
  Quaternion,
  SRGBColorSpace,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { createContactShade, type Patch } from "./contact-shade";
import type { WithRow } from "./furniture";
import { painted } from "./painted";
import { createSurface, type RoomLight } from "./surface";

/** The rig that stands on it. */
export const KIT_RIG = "drumkit";

/** In the kit's frame, whose origin is under the stool: to the player's left and right, behind and before, metres. */
const PLATFORM = { left: 0.98, right: -1.42, back: -0.62, front: 1.58 } as const;
const RUG = { left: 0.86, right: -1.3, back: -0.5, front: 1.46 } as const;
const RUG_THICK = 0.006;
/** A platform is a box that goes down to the floor; one that is lower than this would only be seen as an edge. */
const DEEP = 0.6;

/** How far the kit's feet sink into the rug: enough that it covers the edge of the riser behind. */
const SUNK = 0.003;

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

/** Old wool: everything a little grey. */
const FIELD = "#262c3b";
const BORDER = "#4a2422";
const SAND = "#8f7a58";
const FADED = "#5b5a58";

type Place = readonly [x: number, y: number];

/** A rug's picture: a border of lozenges around a field that is strewn with small ones. */
function rugPicture(): CanvasTexture {
  const [width, height] = [1024, 930];
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const draw = canvas.getContext("2d");
  if (draw !== null) drawRug(draw, width, height);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}

function drawRug(draw: CanvasRenderingContext2D, width: number, height: number): void {
  const frame = (inset: number, color: string): void => {
    draw.fillStyle = color;
    draw.fillRect(inset, inset, width - 2 * inset, height - 2 * inset);
  };
  const lozenge = ([x, y]: Place, size: number, color: string): void => {
    draw.fillStyle = color;
    draw.beginPath();
    draw.moveTo(x, y - 1.25 * size);
    draw.lineTo(x + size, y);
    draw.lineTo(x, y + 1.25 * size);
    draw.lineTo(x - size, y);
    draw.fill();
  };
  const bands = [FIELD, SAND, BORDER, SAND, FIELD, SAND, BORDER, FIELD];
  [0, 10, 13, 30, 33, 100, 103, 118].forEach((inset, i) => frame(inset, bands[i] ?? FIELD));
  const across = Array.from({ length: 26 }, (_, i) => 66 + (i * (width - 132)) / 25);
  const along = Array.from({ length: 24 }, (_, i) => 66 + (i * (height - 132)) / 23);
  const border = [
    ...across.flatMap((x): Place[] => [66, height - 66].map((y): Place => [x, y])),
    ...along.slice(1, -1).flatMap((y): Place[] => [66, width - 66].map((x): Place => [x, y])),
  ];
  border.forEach((place, i) => {
    lozenge(place, 15, i % 2 === 0 ? SAND : FADED);
    lozenge(place, 11, BORDER);
    lozenge(place, 4, SAND);
  });
  for (let row = 0; row < 12; row++) {
    for (let column = 0; column < 14; column++) {
      const place: Place = [166 + column * 56 - (row % 2) * 28, 168 + row * 54];
      if (place[0] < 150) continue;
      lozenge(place, 11, (row + column) % 3 === 0 ? SAND : FADED);
      lozenge(place, 8, FIELD);
      lozenge(place, 3, (row + column) % 3 === 0 ? BORDER : SAND);
    }
  }
}

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

export class KitPlace {
  readonly object = new Group();
  readonly #kit = { node: null as Object3D | null };
  readonly #inTheWay: readonly { readonly mesh: InstancedMesh; readonly without: number; readonly all: number }[];
  readonly #turn = new Quaternion();
  readonly #scale = new Vector3();

  /** @param inTheWay what of the room is put away while a kit stands there. */
  constructor(light: RoomLight, inTheWay: readonly WithRow[]) {
    this.#inTheWay = inTheWay.map(({ mesh, without }) => ({ mesh, without, all: mesh.count }));
    const { front, left, right } = PLATFORM;
    const edge = new BoxGeometry(left - right, 0.03, 0.03).translate((left + right) / 2, -0.024, front);
    const wood = createSurface({ vertexColors: true, roughness: 0.55, metalness: 0, envMapIntensity: 0.35 }, light, {});
    const platform = new Mesh(
      mergeGeometries([painted(slab(PLATFORM, DEEP, -RUG_THICK), 0x38251a), painted(edge, 0x7a5a3c)]),
      wood,
    );
    const cloth = createSurface({ map: rugPicture(), roughness: 0.95, metalness: 0, envMapIntensity: 0.25 }, light, {
      declarations: WEAVE,
      color: "diffuseColor.rgb *= weave(vRoomPlace.xz);",
    });
    const rug = new Mesh(slab(RUG, RUG_THICK, SUNK), cloth);
    for (const mesh of [platform, rug]) mesh.receiveShadow = true;
    platform.castShadow = true;
    platform.name = "kit platform";
    rug.name = "kit rug";
    const shade = createContactShade(SHADE);
    shade.position.y = SUNK;
    this.object.add(platform, rug, shade);
    this.object.name = "kit place";
    this.set(null);
  }

  /** @param node the kit's root; null where there is none. */
  set(node: Object3D | null): void {
    this.#kit.node = node;
    this.object.visible = node !== null;
    for (const { mesh, without, all } of this.#inTheWay) mesh.count = node === null ? all : without;
  }

  /** Go where the kit is; after the scene's world matrices are up to date. */
  follow(): void {
    const { node } = this.#kit;
    if (node === null) return;
    node.matrixWorld.decompose(this.object.position, this.#turn, this.#scale);
    this.object.quaternion.copy(this.#turn);
    this.object.updateMatrixWorld();
  }

  /** How far the kit reaches from the room's middle, metres; 0 where there is none. */
  get reach(): number {
    if (this.#kit.node === null) return 0;
    const { x, z } = this.object.position;
    return Math.hypot(x, z) + KIT_HALF;
  }
}

/** From under the stool to the outermost of what casts a shadow, as it is seen from the key. */
const KIT_HALF = 0.6;
