/** Music stands and chairs: a row on the riser, and a few left about the room. */

import { BoxGeometry, type BufferGeometry, CylinderGeometry, InstancedMesh, type Material, Matrix4 } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { type Patch } from "./contact-shade";
import { RISERS } from "./plan";
import { createSurface, type RoomLight } from "./surface";

/** x, z, heading about +y and height of what it stands on, metres and radians. */
type Place = readonly [x: number, z: number, heading: number, y?: number];

const RISER = RISERS[0].height;

/** What stands in many places, last in those where a drum kit would, and in how many without them. */
export interface WithRow {
  readonly mesh: InstancedMesh;
  readonly without: number;
}

/** The row where a drum kit would stand: put away for one. */
const STANDS_OF_THE_ROW: readonly Place[] = [
  [-1.95, -2.52, 0.32, RISER],
  [-1.1, -2.5, 0.18, RISER],
  [-0.2, -2.56, 0.02, RISER],
];

const STANDS: readonly Place[] = [
  [3.55, -0.1, -0.9],
  [-3.6, -0.9, 0.9],
  [-3.15, -1.75, 0.65],
  [2.75, -1.7, -0.5],
];

const CHAIRS_OF_THE_ROW: readonly Place[] = [
  [-2.0, -3.1, 0.32, RISER],
  [-1.2, -3.12, 0.16, RISER],
  [-0.35, -3.16, -0.03, RISER],
];

const CHAIRS: readonly Place[] = [
  [4.0, -0.45, -0.9],
  [-4.0, -1.25, 0.9],
  [-3.55, -2.15, 0.65],
  [3.1, -2.15, -0.5],
  [3.75, 1.9, -1.35],
  [-3.8, 1.6, 1.4],
];

/** Rows for those who listen, at the front of the room, with a way through the middle. */
const AUDIENCE: readonly Place[] = [6.3, 7.2, 8.1].flatMap((z) =>
  [-2.6, -2.0, -1.4, -0.8, 0.8, 1.4, 2.0, 2.6].map((x): Place => [x, z + 0.045 * x * x - 0.1, Math.PI + 0.07 * x]),
);

function rod(from: [number, number, number], to: [number, number, number], radius: number): BufferGeometry {
  const [x, y, z] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const length = Math.hypot(x, y, z);
  return new CylinderGeometry(radius, radius, length, 8)
    .translate(0, length / 2, 0)
    .rotateX(Math.acos(y / length))
    .rotateY(Math.atan2(x, z))
    .translate(...from);
}

/** A desk on a tube with three feet; who plays stands behind it, at −z. */
function standGeometry(): BufferGeometry {
  const desk = new BoxGeometry(0.5, 0.34, 0.006).translate(0, 0.17, 0);
  const lip = new BoxGeometry(0.5, 0.008, 0.055).translate(0, 0.004, -0.028);
  const tilted = [desk, lip].map((part) => part.rotateX(0.8).translate(0, 0.9, -0.08));
  const feet = [0, 1, 2].map((i) => {
    const turn = (i * 2 * Math.PI) / 3 + Math.PI / 2;
    return rod([0, 0.24, 0], [0.27 * Math.cos(turn), 0.012, 0.27 * Math.sin(turn)], 0.009);
  });
  return mergeGeometries([...tilted, rod([0, 0.2, 0], [0, 0.98, 0], 0.012), ...feet]);
}

/** A stacking chair that faces +z. */
function chairGeometry(): BufferGeometry {
  const seat = new BoxGeometry(0.4, 0.025, 0.4).translate(0, 0.44, 0);
  const back = new BoxGeometry(0.4, 0.2, 0.018).rotateX(-0.14).translate(0, 0.74, -0.235);
  const legs = [-0.18, 0.18].flatMap((x) => [
    rod([x, 0, 0.19], [x, 0.44, 0.17], 0.011),
    rod([x, 0, -0.24], [x, 0.45, -0.18], 0.011),
    rod([x, 0.42, -0.18], [x, 0.82, -0.25], 0.011),
  ]);
  return mergeGeometries([seat, back, ...legs]);
}

function place(geometry: BufferGeometry, material: Material, places: readonly Place[]): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, places.length);
  const matrix = new Matrix4();
  places.forEach(([x, z, heading, y = 0], i) =>
    mesh.setMatrixAt(i, matrix.makeRotationY(heading).setPosition(x, y, z)),
  );
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  mesh.computeBoundingSphere();
  return mesh;
}

/** Music stands and chairs; the last of each are the row's. */
export function createFurniture(light: RoomLight): readonly WithRow[] {
  const enamel = createSurface({ color: 0x2e2f33, roughness: 0.6, envMapIntensity: 0.5 }, light, {});
  const wood = createSurface({ color: 0x4a2c1a, roughness: 0.7, envMapIntensity: 0.5 }, light, {});
  const chairs = [...CHAIRS, ...AUDIENCE];
  return [
    { mesh: place(standGeometry(), enamel, [...STANDS, ...STANDS_OF_THE_ROW]), without: STANDS.length },
    { mesh: place(chairGeometry(), wood, [...chairs, ...CHAIRS_OF_THE_ROW]), without: chairs.length },
  ];
}

function shadeOf(stands: readonly Place[], chairs: readonly Place[]): Patch[] {
  return [
    ...stands.map(([x, z, , y]): Patch => [x, z, 0.62, 0.62, y ?? 0]),
    ...chairs.map(([x, z, , y]): Patch => [x, z, 0.78, 0.78, y ?? 0]),
  ];
}

/** What lies in the shade of stands and chairs. */
export const FURNITURE_SHADE: readonly Patch[] = shadeOf(STANDS, [...CHAIRS, ...AUDIENCE]);
export const ROW_SHADE: readonly Patch[] = shadeOf(STANDS_OF_THE_ROW, CHAIRS_OF_THE_ROW);
