/** What hangs and stands along the walls: blackboard, clock, pictures, door, radiators, curtains, beams and lamps. */

import {
  BoxGeometry,
  type BufferGeometry,
  CylinderGeometry,
  PlaneGeometry,
  SphereGeometry,
  TorusGeometry,
} from "three";

import { noticeBoard } from "./notice-board";
import { acrossTheRoom, BRASS, CREAM, DARK_WOOD, door, frame, onBackWall, pictures, WOOD } from "./on-wall";
import { painted } from "./painted";
import { PANELLING, ROOM, WINDOWS } from "./plan";

const SLATE = 0x24352f;
const CHALK = 0xb9bfb2;
const IRON = 0x8d877c;
const LINEN = 0xa5937a;

/** Chalked staves, and notes on them: x along the board and step above the lowest line, in lines' distances. */
const STAVES = [0.3, -0.26] as const;
const LINE = 0.058;
const NOTES = [
  [-1.12, 2],
  [-0.9, 2.5],
  [-0.68, 3],
  [-0.46, 3.5],
  [-0.2, 3],
  [0.1, 1.5],
  [0.32, 2],
  [0.54, 2.5],
  [0.76, 2],
  [1.06, 0.5],
] as const;

function blackboard(x: number, y: number): BufferGeometry[] {
  const [width, height] = [3.1, 1.22];
  const parts = [onBackWall(width, height, 0.015, x, y, SLATE), ...frame(width, height, 0.06, 0.035, x, y, WOOD)];
  parts.push(onBackWall(width + 0.1, 0.025, 0.09, x, y - height / 2 - 0.07, WOOD));
  for (const stick of [-0.7, -0.62, 0.5])
    parts.push(onBackWall(0.06, 0.012, 0.012, x + stick, y - height / 2 - 0.05, CREAM, 0.05));
  for (const middle of STAVES) {
    for (let line = -2; line <= 2; line++)
      parts.push(onBackWall(2.6, 0.006, 0.002, x, y + middle + line * LINE, CHALK, 0.015));
    for (const bar of [-1.3, -0.05, 1.3])
      parts.push(onBackWall(0.006, 4 * LINE, 0.002, x + bar, y + middle, CHALK, 0.015));
    for (const [along, step] of middle > 0 ? NOTES : NOTES.slice(2, 9)) {
      const at = y + middle + (step - 2) * LINE;
      const head = new SphereGeometry(0.5, 10, 6).scale(0.062, 0.044, 0.004).rotateZ(0.35);
      parts.push(painted(head.translate(x + along, at, ROOM.back + 0.018), CHALK));
      const up = step < 2 ? 1 : -1;
      parts.push(onBackWall(0.007, 0.19, 0.002, x + along + up * 0.028, at + up * 0.1, CHALK, 0.016));
    }
  }
  return parts;
}

function clock(x: number, y: number): BufferGeometry[] {
  const face = new CylinderGeometry(0.17, 0.17, 0.03, 40).rotateX(Math.PI / 2).translate(x, y, ROOM.back + 0.03);
  const rim = new TorusGeometry(0.175, 0.018, 10, 40).translate(x, y, ROOM.back + 0.04);
  const hand = (length: number, width: number, turn: number): BufferGeometry =>
    painted(
      new BoxGeometry(width, length, 0.004)
        .translate(0, length * 0.42, 0)
        .rotateZ(turn)
        .translate(x, y, ROOM.back + 0.05),
      DARK_WOOD,
    );
  const marks = Array.from({ length: 12 }, (_, hour) =>
    painted(
      new BoxGeometry(0.006, 0.022, 0.002)
        .translate(0, 0.145, 0)
        .rotateZ((hour * Math.PI) / 6)
        .translate(x, y, ROOM.back + 0.046),
      DARK_WOOD,
    ),
  );
  // Ten past four.
  return [painted(face, CREAM), painted(rim, DARK_WOOD), hand(0.09, 0.012, -2.18), hand(0.14, 0.008, -1.05), ...marks];
}

/** Ribs of cast iron under a window. */
function radiator(side: -1 | 1, z: number): BufferGeometry[] {
  return Array.from({ length: 13 }, (_, i) =>
    painted(
      new BoxGeometry(0.11, 0.56, 0.055).translate(side * (ROOM.halfWidth - 0.12), 0.4, z + (i - 6) * 0.08),
      IRON,
    ),
  );
}

/** A curtain drawn aside, in folds. */
function curtain(side: -1 | 1, z: number): BufferGeometry {
  const height = WINDOWS.head - 0.35 + 0.25;
  const cloth = new PlaneGeometry(0.42, height, 24, 1).rotateY((-side * Math.PI) / 2);
  const position = cloth.getAttribute("position");
  for (let i = 0; i < position.count; i++) position.setX(i, -side * 0.035 * (1 + Math.sin(position.getZ(i) * 75)));
  cloth.computeVertexNormals();
  return painted(cloth.translate(side * (ROOM.halfWidth - 0.05), 0.35 + height / 2, z), LINEN);
}

function windowSides(side: -1 | 1): BufferGeometry[] {
  const length = ROOM.front - ROOM.back;
  const rod = new CylinderGeometry(0.018, 0.018, length, 8).rotateX(Math.PI / 2);
  const parts: BufferGeometry[] = [
    painted(rod.translate(side * (ROOM.halfWidth - 0.09), WINDOWS.head + 0.22, (ROOM.front + ROOM.back) / 2), BRASS),
  ];
  for (let i = 0; i < WINDOWS.count; i++) {
    const z = WINDOWS.first + i * WINDOWS.pitch;
    parts.push(...radiator(side, z));
    for (const end of [-1, 1]) parts.push(curtain(side, z + end * (WINDOWS.width / 2 + 0.14)));
    const board = new BoxGeometry(0.16, 0.04, WINDOWS.width + 0.3).translate(
      side * (ROOM.halfWidth - 0.06),
      WINDOWS.sill - 0.06,
      z,
    );
    parts.push(painted(board, DARK_WOOD));
  }
  return parts;
}

/** Beams across, and a globe on a rod below every other one. */
function ceiling(): BufferGeometry[] {
  const parts: BufferGeometry[] = [];
  for (let i = 0; i < 6; i++) {
    const z = ROOM.back + 0.6 + i * 2.15;
    parts.push(painted(new BoxGeometry(2 * ROOM.halfWidth, 0.26, 0.2).translate(0, ROOM.height - 0.13, z), DARK_WOOD));
    if (i % 2 !== 0) continue;
    for (const x of [-2.2, 2.2]) {
      parts.push(painted(new CylinderGeometry(0.008, 0.008, 0.9, 6).translate(x, ROOM.height - 0.6, z), DARK_WOOD));
      parts.push(painted(new CylinderGeometry(0.05, 0.05, 0.06, 16).translate(x, ROOM.height - 0.98, z), BRASS));
      parts.push(painted(new SphereGeometry(0.15, 20, 14).translate(x, ROOM.height - 1.14, z), 0xf1e8d4));
    }
  }
  return parts;
}

/** Rails along a wall: panelling, picture rail, skirting. */
function rails(): BufferGeometry[] {
  return [
    onBackWall(2 * ROOM.halfWidth, 0.05, 0.03, 0, PANELLING, DARK_WOOD),
    onBackWall(2 * ROOM.halfWidth, 0.04, 0.03, 0, 3.55, WOOD),
    onBackWall(2 * ROOM.halfWidth, 0.14, 0.02, 0, 0.07, DARK_WOOD),
  ];
}

/** Everything on the walls and under the ceiling, painted. */
export function wallFittings(): BufferGeometry[] {
  return [
    ...blackboard(-0.15, 1.92),
    ...clock(-0.15, 3.05),
    ...pictures(3.1, 2.35),
    ...door(-3.2),
    ...rails(),
    ...acrossTheRoom([...rails(), ...door(-0.5), ...door(0.5), ...noticeBoard(-2.6, 1.85), ...pictures(2.3, 2.1)]),
    ...windowSides(-1),
    ...windowSides(1),
    ...ceiling(),
  ];
}
