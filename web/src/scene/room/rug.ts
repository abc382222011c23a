/** The picture of a woven rug: a border of lozenges around a field that is strewn with small ones. */

import { DataTexture, LinearFilter, LinearMipmapLinearFilter, SRGBColorSpace } from "three";

type Color = readonly [red: number, green: number, blue: number];

/** Old wool, sRGB: everything a little grey. */
const FIELD: Color = [38, 44, 59];
const BORDER: Color = [74, 36, 34];
const SAND: Color = [143, 122, 88];
const FADED: Color = [91, 90, 88];

/** Widths are shares of the rug's own; bands from the edge in, each with where it begins. */
const BANDS: readonly (readonly [from: number, color: Color])[] = [
  [0.118, FIELD],
  [0.103, BORDER],
  [0.1, SAND],
  [0.033, FIELD],
  [0.03, SAND],
  [0.013, BORDER],
  [0.01, SAND],
];
const BORDER_MIDDLE = 0.0665;
const BORDER_STEP = 0.0355;
const FIELD_STEP = 0.055;
const TALL = 1.25;

const WIDTH = 768;

/** How far from a lozenge's middle, as a share of its half width. */
function lozenge(x: number, y: number, half: number): number {
  return (Math.abs(x) + Math.abs(y) / TALL) / half;
}

/** Off the middle of the cell that a place lies in, and the cell's number. */
function cell(at: number, step: number): readonly [off: number, number: number] {
  const number = Math.round(at / step);
  return [at - number * step, number];
}

function colorAt(x: number, y: number, height: number): Color {
  const inX = Math.min(x, 1 - x);
  const inY = Math.min(y, height - y);
  const inside = Math.min(inX, inY);
  if (inside > 0.033 && inside < 0.1) {
    const [along, number] = cell((inX < inY ? y - height / 2 : x - 0.5) + BORDER_STEP / 2, BORDER_STEP);
    const across = inside - BORDER_MIDDLE;
    const away = inX < inY ? lozenge(across, along, 0.0145) : lozenge(along, across, 0.0145);
    if (away < 0.3) return SAND;
    if (away < 0.72) return BORDER;
    if (away < 1) return number % 2 === 0 ? SAND : FADED;
  }
  const [dy, row] = cell(y - height / 2, FIELD_STEP);
  const [dx, column] = cell(x - 0.5 + (row % 2 === 0 ? 0 : FIELD_STEP / 2), FIELD_STEP);
  // A whole lozenge or none.
  if (Math.min(x - dx, 1 - x + dx, y - dy, height - y + dy) > 0.15) {
    const away = lozenge(dx, dy, 0.0105);
    const third = (row + column) % 3 === 0;
    if (away < 0.3) return third ? BORDER : SAND;
    if (away > 0.72 && away < 1) return third ? SAND : FADED;
  }
  return BANDS.find(([from]) => inside >= from)?.[1] ?? FIELD;
}

/** @param proportion the rug's depth as a share of its width. */
export function createRug(proportion: number): DataTexture {
  const height = Math.round(WIDTH * proportion);
  const pixels = new Uint8Array(4 * WIDTH * height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < WIDTH; column++) {
      const color = colorAt((column + 0.5) / WIDTH, (row + 0.5) / WIDTH, height / WIDTH);
      pixels.set([...color, 255], 4 * (row * WIDTH + column));
    }
  }
  const texture = new DataTexture(pixels, WIDTH, height);
  texture.colorSpace = SRGBColorSpace;
  texture.generateMipmaps = true;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}
