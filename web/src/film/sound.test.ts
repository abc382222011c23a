import { expect, it } from "vitest";

import { cutSound } from "./sound";

it("gives the channels one after the other, and silence after the end", () => {
  const sound = cutSound([Float32Array.of(1, 2, 3), Float32Array.of(-1, -2, -3)], 5);
  expect([...sound.planes(0, 2)]).toEqual([1, 2, -1, -2]);
  expect([...sound.planes(2, 5)]).toEqual([3, 0, 0, -3, 0, 0]);
  expect([...sound.planes(4, 5)]).toEqual([0, 0]);
});
