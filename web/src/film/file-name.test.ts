import { expect, it } from "vitest";

import { fileName } from "./file-name";

it.each([
  ["Ode to Joy", "Ode to Joy.mp4"],
  ["Étude: 1/2", "Étude 1 2.mp4"],
  ["../../etc/passwd", "etc passwd.mp4"],
  ["a\u0000b\u202ec\n", "a b c.mp4"],
  ["  .hidden. ", "hidden.mp4"],
  ["CON", "CON film.mp4"],
  ["???", "Reina.mp4"],
  ["", "Reina.mp4"],
  ["さくら", "さくら.mp4"],
  ["🎺".repeat(100), `${"🎺".repeat(60)}.mp4`],
])("%s", (title, name) => {
  expect(fileName(title, "mp4")).toBe(name);
});
