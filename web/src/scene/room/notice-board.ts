/** A cork board with the term's notices. */

import { BoxGeometry, type BufferGeometry } from "three";

import { CREAM, DARK_WOOD, frame, onBackWall } from "./on-wall";
import { painted } from "./painted";
import { ROOM } from "./plan";

const CORK = 0x8a6a45;
const [WIDTH, HEIGHT] = [2.0, 1.1];

/** Sheets: middle, size, turn and colour; the poster of a concert is the large one. */
const SHEETS = [
  [-0.78, 0.22, 0.24, 0.34, 0.03, CREAM],
  [-0.44, 0.24, 0.24, 0.34, -0.02, CREAM],
  [-0.62, -0.24, 0.3, 0.21, 0.05, 0xd7c68f],
  [0.02, 0.04, 0.46, 0.66, 0, 0x7c2f2b],
  [0.46, 0.26, 0.24, 0.34, -0.04, 0xbfc7c4],
  [0.76, 0.18, 0.2, 0.28, 0.02, CREAM],
  [0.6, -0.26, 0.34, 0.24, -0.03, CREAM],
] as const;

/** Its middle at x, y on the wall behind, metres. */
export function noticeBoard(x: number, y: number): BufferGeometry[] {
  const sheets = SHEETS.map(([dx, dy, width, height, turn, hex]) =>
    painted(new BoxGeometry(width, height, 0.002).rotateZ(turn).translate(x + dx, y + dy, ROOM.back + 0.02), hex),
  );
  // What the poster says, as far as it can be read from the stage.
  const words = [0.2, 0.12, -0.16].map((dy, i) =>
    onBackWall(i === 0 ? 0.34 : 0.24, i === 0 ? 0.07 : 0.025, 0.001, x + 0.02, y + 0.04 + dy, 0xe2c98a, 0.022),
  );
  return [
    onBackWall(WIDTH, HEIGHT, 0.015, x, y, CORK),
    ...frame(WIDTH, HEIGHT, 0.05, 0.03, x, y, DARK_WOOD),
    ...sheets,
    ...words,
  ];
}
