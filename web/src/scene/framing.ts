/**
 * The show frames its pictures for 16:9. A wider window sees more. A narrower one sees more above and below and
 * gives up a little at the sides, down to the middle two thirds: what a camera looks at stands in the middle, and a
 * whole frame on an upright phone would leave the player as tall as a thumbnail.
 */

export const SHOW_ASPECT = 16 / 9;

/** Half a turn and over cannot be drawn in perspective. */
const WIDEST_FOV = (170 * Math.PI) / 180;

/** What lies over the picture's edges, pixels from each. */
export interface Insets {
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
  readonly left: number;
}

/** How the show's 16:9 frame lies in a window. */
export interface Fit {
  /** Height of the window over that of the frame. */
  readonly widening: number;
  /** From the middle of the window to that of the frame, pixels to the right and down. */
  readonly shiftX: number;
  readonly shiftY: number;
}

/** The least share of a side that is left to the picture, whatever lies over it. */
const MIN_FREE = 0.3;

/** The free stretch of a side: where it begins, and how long it is. */
function freeStretch(length: number, before: number, after: number): [start: number, extent: number] {
  const covered = Math.max(1e-6, before + after);
  const share = Math.min(1, (length * (1 - MIN_FREE)) / covered);
  return [before * share, length - (before + after) * share];
}

/** The least share of the frame's width that a narrow window keeps. */
const MIN_WIDTH = 0.66;

/** The share of the frame's width that a window of an aspect keeps: all from 16:9 on, the least at a square and beyond. */
export function keptWidth(aspect: number): number {
  const wideness = Math.min(1, Math.max(0, (aspect - 1) / (SHOW_ASPECT - 1)));
  return MIN_WIDTH + (1 - MIN_WIDTH) * wideness;
}

/** The largest 16:9 frame, less what a narrow window gives up of its sides, in the middle of what is free of a window. */
export function fitFrame(width: number, height: number, insets: Insets): Fit {
  const [left, freeWidth] = freeStretch(width, insets.left, insets.right);
  const [top, freeHeight] = freeStretch(height, insets.top, insets.bottom);
  return {
    widening: Math.max(1, height / Math.min(freeHeight, freeWidth / (SHOW_ASPECT * keptWidth(freeWidth / freeHeight)))),
    shiftX: left + freeWidth / 2 - width / 2,
    shiftY: top + freeHeight / 2 - height / 2,
  };
}

/**
 * Vertical field of view of a window in which the show's frame is `widening` times lower than the window:
 * tan(v'/2) = tan(v/2) · widening.
 *
 * @param fov of the frame, vertical, radians.
 * @returns radians.
 */
export function widen(fov: number, widening: number): number {
  if (widening === 1) return fov;
  return Math.min(WIDEST_FOV, 2 * Math.atan(Math.tan(fov / 2) * widening));
}
