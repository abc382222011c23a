/** Views of a cast as it stands: everybody, or one of them. Each is framed for 16:9. */

import type { FramedView } from "./camera-presets";
import { SHOW_ASPECT, keptWidth } from "./framing";
import type { Stand } from "./players";

/** Room about the outermost players, metres: elbows and bells. */
const MARGIN = 0.62;
/** The middle of what is to be seen, and half its height, metres: figures, and room below them for the transport. */
const MIDDLE = 0.84;
const HALF_HEIGHT = 1.1;
const FOV = 0.43;
/** How far from the middle of the audience the camera stands, a turn to its left, radians, and its height, metres. */
const ASIDE = 0.2;
const EYE = 1.45;
/** As far back as the room lets it, metres from the middle of the cast. */
const FARTHEST = 6.4;

/** One player, from the side of the valves: from where and to where, as they stand in the middle facing the audience. */
const NEAR = { position: [-1.62, 1.56, 2.4], target: [0.06, 1.29, 0.28], fov: 0.5 } as const;

/**
 * Everybody, from the front and a little aside.
 *
 * @param aspect width over height of the window: one narrower than 16:9 gives up some of the frame's sides.
 */
export function castView(stands: readonly Stand[], aspect: number): FramedView {
  const [left, right] = extent(stands.map(({ x }) => x));
  const [back, front] = extent(stands.map(({ z }) => z));
  const [x, z] = [(left + right) / 2, (back + front) / 2];
  const halfWidth = (right - left) / 2 + MARGIN;
  const across = Math.max(HALF_HEIGHT, halfWidth / (SHOW_ASPECT * keptWidth(aspect)));
  const distance = Math.min(FARTHEST, across / Math.tan(FOV / 2) + (front - back) / 2);
  return {
    position: [x - distance * Math.sin(ASIDE), EYE, z + distance * Math.cos(ASIDE)],
    target: [x, MIDDLE, z],
    fov: 2 * Math.atan(across / (distance - (front - back) / 2)),
  };
}

/** One player as the three-quarter view shows who stands in the middle. */
export function playerView(stand: Stand): FramedView {
  return viewAt(NEAR, stand);
}

/**
 * A view of who stands in the middle facing the audience, of a player wherever the seat is and whichever way it faces;
 * never from farther aside than there, where the neighbours stand in the way.
 */
export function viewAt(view: FramedView, { x, z, facing }: Stand): FramedView {
  const turn = Math.max(facing, 0);
  const [sin, cos] = [Math.sin(turn), Math.cos(turn)];
  const placed = ([px, py, pz]: readonly [number, number, number]): [number, number, number] => [
    x + px * cos + pz * sin,
    py,
    z - px * sin + pz * cos,
  ];
  return { position: placed(view.position), target: placed(view.target), fov: view.fov };
}

function extent(values: readonly number[]): [least: number, most: number] {
  return [
    Math.min(...values, ...(values.length === 0 ? [0] : [])),
    Math.max(...values, ...(values.length === 0 ? [0] : [])),
  ];
}
