/** How large a film's picture is. */

export const ASPECTS = ["16:9", "1:1", "9:16"] as const;
export type Aspect = (typeof ASPECTS)[number];

/** What each height is called: that of a 16:9 picture, the shorter side of any. */
export const HEIGHTS = [
  { height: 720, name: "720p" },
  { height: 1080, name: "1080p" },
  { height: 1440, name: "1440p" },
  { height: 2160, name: "4K" },
] as const;

export const FPS = [30, 60] as const;
export type Fps = (typeof FPS)[number];

export const SMALLEST_HEIGHT = 144;
export const LARGEST_HEIGHT = 2160;

export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** Width over height, of the picture lying on its longer side. */
const LONG_OVER_SHORT: Readonly<Record<Aspect, number>> = { "16:9": 16 / 9, "1:1": 1, "9:16": 16 / 9 };

/**
 * Pixels of a picture. Both sides are even, as encoders want them.
 *
 * @param height the shorter side, as `1080p` counts it: 9:16 at 1080 is 1080 × 1920.
 */
export function pictureSize(aspect: Aspect, height: number): PictureSize {
  const short = even(height);
  const long = even(short * LONG_OVER_SHORT[aspect]);
  return aspect === "9:16" ? { width: short, height: long } : { width: long, height: short };
}

function even(pixels: number): number {
  return 2 * Math.round(pixels / 2);
}
