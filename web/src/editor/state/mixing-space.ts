import type { ShowTrack } from "./show-document";

/** Three components of a colour. */
export type Triple = readonly [number, number, number];

/** Where a track's colours are mixed, and where its slopes are told; a curve's components are linear sRGB. */
export interface MixingSpace {
  /** Linear sRGB as a point of the space. */
  to(linear: Triple): Triple;
  /** The inverse of `to`. */
  from(point: Triple): Triple;
}

const LINEAR: MixingSpace = { to: (linear) => linear, from: (point) => point };

/** OKLab, Björn Ottosson 2020, https://bottosson.github.io/posts/oklab/; the matrices are those of the server. */
const LMS_FROM_LINEAR: readonly Triple[] = [
  [0.4122214708, 0.5363325363, 0.0514459929],
  [0.2119034982, 0.6806995451, 0.1073969566],
  [0.0883024619, 0.2817188376, 0.6299787005],
];
const LAB_FROM_ROOTS: readonly Triple[] = [
  [0.2104542553, 0.793617785, -0.0040720468],
  [1.9779984951, -2.428592205, 0.4505937099],
  [0.0259040371, 0.7827717662, -0.808675766],
];
const LINEAR_FROM_LMS = inverse(LMS_FROM_LINEAR);
const ROOTS_FROM_LAB = inverse(LAB_FROM_ROOTS);

const OKLAB: MixingSpace = {
  to: (linear) => times(LAB_FROM_ROOTS, each(times(LMS_FROM_LINEAR, linear), Math.cbrt)),
  from: (point) =>
    times(
      LINEAR_FROM_LMS,
      each(times(ROOTS_FROM_LAB, point), (root) => root ** 3),
    ),
};

export function mixingSpaceOf({ color_space }: Pick<ShowTrack, "color_space">): MixingSpace {
  return color_space === "linear" ? LINEAR : OKLAB;
}

function each([a, b, c]: Triple, of: (component: number) => number): Triple {
  return [of(a), of(b), of(c)];
}

function times(matrix: readonly Triple[], [x, y, z]: Triple): Triple {
  const [first = 0, second = 0, third = 0] = matrix.map(([a, b, c]) => a * x + b * y + c * z);
  return [first, second, third];
}

/** The inverse of a 3 by 3 matrix, by its cofactors. */
function inverse([[a, b, c] = [1, 0, 0], [d, e, f] = [0, 1, 0], [g, h, i] = [0, 0, 1]]: readonly Triple[]): Triple[] {
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  const rows: readonly Triple[] = [
    [e * i - f * h, c * h - b * i, b * f - c * e],
    [f * g - d * i, a * i - c * g, c * d - a * f],
    [d * h - e * g, b * g - a * h, a * e - b * d],
  ];
  return rows.map((row) => each(row, (cofactor) => cofactor / determinant));
}
