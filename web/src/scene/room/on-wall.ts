/** What is built flat against a wall: boxes with their backs on it, frames, doors and pictures. */

import { BoxGeometry, type BufferGeometry, SphereGeometry } from "three";

import { painted } from "./painted";
import { ROOM } from "./plan";

export const WOOD = 0x4b2d1b;
export const DARK_WOOD = 0x2e1b11;
export const CREAM = 0xe4dcc8;
export const BRASS = 0x9c7a3a;

/** A box with its middle at x, y and its back on the wall behind, metres. */
export function onBackWall(
  width: number,
  height: number,
  depth: number,
  x: number,
  y: number,
  hex: number,
  out = 0,
): BufferGeometry {
  return painted(new BoxGeometry(width, height, depth).translate(x, y, ROOM.back + out + depth / 2), hex);
}

/** A frame of four bars about an opening. */
export function frame(
  width: number,
  height: number,
  bar: number,
  depth: number,
  x: number,
  y: number,
  hex: number,
): BufferGeometry[] {
  return [-1, 1].flatMap((side) => [
    onBackWall(bar, height + 2 * bar, depth, x + (side * (width + bar)) / 2, y, hex),
    onBackWall(width, bar, depth, x, y + (side * (height + bar)) / 2, hex),
  ]);
}

/** Bands of former years, too far away to be made out. */
export function pictures(x: number, y: number): BufferGeometry[] {
  const each = [
    [0, 0, 0.5, 0.36],
    [0.66, 0.02, 0.42, 0.5],
    [-0.62, -0.03, 0.4, 0.3],
  ] as const;
  return each.flatMap(([dx, dy, width, height]) => [
    ...frame(width, height, 0.03, 0.03, x + dx, y + dy, DARK_WOOD),
    onBackWall(width, height, 0.012, x + dx, y + dy, CREAM),
    onBackWall(width * 0.72, height * 0.62, 0.002, x + dx, y + dy, 0x6f5e4c, 0.012),
    onBackWall(width * 0.6, height * 0.2, 0.002, x + dx, y + dy - height * 0.12, 0x2f2a2a, 0.014),
  ]);
}

/** A panelled door in its frame. */
export function door(x: number): BufferGeometry[] {
  const [width, height] = [0.95, 2.1];
  const panels = [0.32, 0.95, 1.65].map((y) => onBackWall(width - 0.3, 0.46, 0.012, x, y, 0x55341f, 0.04));
  const knob = new SphereGeometry(0.032, 12, 8).translate(x + 0.38, 1.02, ROOM.back + 0.1);
  return [
    onBackWall(width, height, 0.04, x, height / 2, WOOD),
    ...frame(width, height, 0.09, 0.06, x, height / 2, DARK_WOOD),
    ...panels,
    painted(knob, BRASS),
  ];
}

/** Parts of the wall behind, stood on the wall in front: x turns over with them. */
export function acrossTheRoom(parts: readonly BufferGeometry[]): BufferGeometry[] {
  return parts.map((part) => part.rotateY(Math.PI).translate(0, 0, ROOM.front + ROOM.back));
}
