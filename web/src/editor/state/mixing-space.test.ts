import { expect, it } from "vitest";
import { mixingSpaceOf, type Triple } from "./mixing-space";

/** Linear sRGB and its OKLab, as `reina.curves.color` has them. */
const KNOWN: readonly (readonly [Triple, Triple])[] = [
  [
    [1, 0, 0],
    [0.6279553606145516, 0.22486306106597403, 0.12584629853073506],
  ],
  [
    [1.2, -0.1, 0.4],
    [0.6454952869807471, 0.3538009356265056, -0.05966367254439024],
  ],
];

it("is OKLab unless a track mixes as light adds, there and back", () => {
  const space = mixingSpaceOf({});
  for (const [linear, lab] of KNOWN) {
    space.to(linear).forEach((each, index) => expect(each).toBeCloseTo(lab[index] ?? NaN, 12));
    space.from(lab).forEach((each, index) => expect(each).toBeCloseTo(linear[index] ?? NaN, 9));
  }
  expect(mixingSpaceOf({ color_space: "linear" }).to([0.1, 0.2, 0.3])).toEqual([0.1, 0.2, 0.3]);
});
