/** The show frames its pictures for 16:9; another window sees more, never less. */

export const SHOW_ASPECT = 16 / 9;

/** Half a turn and over cannot be drawn in perspective. */
const WIDEST_FOV = (170 * Math.PI) / 180;

/**
 * Vertical field of view that keeps the 16:9 frame inside a window of another shape.
 *
 * A wider window keeps the height; a narrower one keeps the width: tan(v'/2) = tan(v/2) · (16/9) / aspect.
 *
 * @param fov vertical, radians, for 16:9.
 * @param aspect the window's width over its height.
 * @returns vertical field of view, radians.
 */
export function fitFieldOfView(fov: number, aspect: number): number {
  if (aspect >= SHOW_ASPECT) return fov;
  return Math.min(WIDEST_FOV, 2 * Math.atan((Math.tan(fov / 2) * SHOW_ASPECT) / aspect));
}
