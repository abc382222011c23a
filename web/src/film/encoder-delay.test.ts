import { expect, it } from "vitest";

import { delayOf, pulsed } from "./encoder-delay";

it.each([0, 1, 312, 1024, 2112, 5529])("a pulse that comes %i samples late is found", (delay) => {
  const sent = pulsed();
  const heard = new Float32Array(sent.length + delay);
  // Quieter, the other ear's hum beside it, as codecs leave it.
  for (const [place, sample] of sent.entries()) heard[place + delay] = 0.6 * sample;
  for (const place of heard.keys()) heard[place] = (heard[place] ?? 0) + 0.01 * Math.sin(place / 17);
  expect(Math.abs(delayOf(heard) - delay)).toBeLessThanOrEqual(1);
});

it("there is none in silence", () => {
  expect(delayOf(new Float32Array(20_000))).toBe(0);
});
