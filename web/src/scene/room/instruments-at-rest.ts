/** What a band leaves behind after rehearsal: a piano, kettledrums, cases on a shelf. */

import { BoxGeometry, type BufferGeometry, CylinderGeometry, LatheGeometry, TorusGeometry, Vector2 } from "three";

import { type Patch } from "./contact-shade";
import { painted } from "./painted";
import { RISERS } from "./plan";

const RISER = RISERS[0].height;
const LACQUER = 0x14100e;
const IVORY = 0xe9e2d2;
const COPPER = 0x5f4532;
const SKIN = 0xe3d8c1;
const STEEL = 0x5d5f63;

function box(
  width: number,
  height: number,
  depth: number,
  x: number,
  y: number,
  z: number,
  hex: number,
): BufferGeometry {
  return painted(new BoxGeometry(width, height, depth).translate(x, y, z), hex);
}

/** An upright piano that faces +z, its back at z = 0, with its stool. */
function piano(): BufferGeometry[] {
  const black = Array.from({ length: 36 }, (_, i) => i).filter((i) => ![2, 6].includes(i % 7));
  return [
    box(1.5, 0.62, 0.3, 0, 0.92, 0.15, LACQUER),
    box(1.54, 0.035, 0.36, 0, 1.25, 0.17, LACQUER),
    box(1.5, 0.66, 0.24, 0, 0.33, 0.12, LACQUER),
    box(1.5, 0.1, 0.34, 0, 0.62, 0.43, LACQUER),
    box(1.24, 0.02, 0.15, 0, 0.685, 0.51, IVORY),
    ...black.map((i) => box(0.014, 0.016, 0.09, -0.61 + i * 0.0345, 0.703, 0.48, LACQUER)),
    box(1.4, 0.26, 0.015, 0, 0.86, 0.31, 0x1f1815),
    ...[-0.7, 0.7].map((x) => box(0.07, 0.6, 0.07, x, 0.3, 0.54, LACQUER)),
    ...[-0.08, 0, 0.08].map((x) => box(0.035, 0.015, 0.12, x, 0.06, 0.3, 0x9c7a3a)),
    box(0.6, 0.07, 0.32, 0, 0.5, 0.95, 0x3a2018),
    ...[-0.25, 0.25].flatMap((x) => [0.83, 1.07].map((z) => box(0.04, 0.47, 0.04, x, 0.235, z, LACQUER))),
  ];
}

/** A kettledrum of a diameter, metres. */
function kettledrum(diameter: number): BufferGeometry[] {
  const r = diameter / 2;
  const bowl = Array.from({ length: 15 }, (_, i) => {
    const angle = (i / 14) * (Math.PI / 2);
    return new Vector2(Math.max(0.001, r * Math.sin(angle)), 0.76 - 0.5 * Math.cos(angle));
  });
  const legs = [0.6, 2.7, 4.8].map((turn) =>
    painted(
      new CylinderGeometry(0.016, 0.02, 0.6, 8)
        .translate(0, 0.3, 0)
        .rotateX(0.12)
        .translate(0, 0, r * 0.7)
        .rotateY(turn),
      STEEL,
    ),
  );
  const lugs = Array.from({ length: 8 }, (_, i) =>
    painted(
      new CylinderGeometry(0.009, 0.009, 0.22, 6).translate(r + 0.012, 0.67, 0).rotateY((i * Math.PI) / 4),
      STEEL,
    ),
  );
  return [
    painted(new LatheGeometry(bowl, 36), COPPER),
    painted(new CylinderGeometry(r * 0.985, r * 0.985, 0.02, 36).translate(0, 0.765, 0), SKIN),
    painted(new TorusGeometry(r, 0.014, 8, 40).rotateX(Math.PI / 2).translate(0, 0.775, 0), STEEL),
    ...legs,
    ...lugs,
  ];
}

/** Shelves with instrument cases, their backs at z = 0. */
function shelves(): BufferGeometry[] {
  const oak = 0x5a3a22;
  const boards = [0.06, 0.6, 1.14, 1.68].map((y) => box(1.3, 0.035, 0.42, 0, y, 0.21, oak));
  const sides = [-0.65, 0.65].map((x) => box(0.035, 1.7, 0.42, x, 0.85, 0.21, oak));
  const cases = [
    [-0.42, 0.2, 0.34, 0.26, 0x1d1d20],
    [-0.05, 0.19, 0.3, 0.22, 0x2c2019],
    [0.36, 0.24, 0.42, 0.34, 0x16181d],
    [-0.36, 0.74, 0.5, 0.24, 0x25211f],
    [0.2, 0.72, 0.52, 0.2, 0x191b20],
    [0.52, 0.76, 0.14, 0.28, 0x4a1f1f],
    [-0.3, 1.26, 0.6, 0.2, 0x1f1b19],
    [0.3, 1.28, 0.4, 0.24, 0x23262c],
    [-0.35, 1.8, 0.44, 0.2, 0x1b1b1d],
    [0.28, 1.79, 0.5, 0.18, 0x33251b],
  ] as const;
  return [...boards, ...sides, ...cases.map(([x, y, width, height, hex]) => box(width, height, 0.34, x, y, 0.22, hex))];
}

function stood(parts: readonly BufferGeometry[], x: number, z: number, heading: number, y = 0): BufferGeometry[] {
  return parts.map((part) => part.rotateY(heading).translate(x, y, z));
}

/** All of it, in its places in the room. */
export function instrumentsAtRest(): BufferGeometry[] {
  return [
    ...stood(piano(), 3.0, -3.45, 0),
    ...stood(shelves(), -4.35, -3.1, Math.PI / 2),
    ...stood(kettledrum(0.74), 1.45, -2.95, 0.4, RISER),
    ...stood(kettledrum(0.66), 0.65, -3.1, 0.1, RISER),
  ];
}

/** What lies in their shade. */
export const RESTING_SHADE: readonly Patch[] = [
  [3.0, -3.15, 1.9, 1.1],
  [3.0, -2.5, 0.9, 0.6],
  [-4.1, -3.1, 0.9, 1.6],
  [1.45, -2.95, 0.95, 0.95, RISER],
  [0.65, -3.1, 0.9, 0.9, RISER],
];
