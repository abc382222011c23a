import { Color } from "three";
import { describe, expect, it } from "vitest";

import { companionColor, oklab, paneColor } from "./player-colors";

/** The default, and what the bundled shows and the first show's moods colour blocks with. */
const BASES = ["#D9A441", "#4C6A9A", "#C23B3B", "#F4EFE6", "#6B4FA0", "#3F8F6B", "#808080"];

type Matrix = readonly (readonly [number, number, number])[];

/** How linear sRGB is seen without one kind of cone (Machado, Oliveira and Fernandes 2009, severity 1). */
const EYES: Readonly<Record<string, Matrix>> = {
  "all cones": [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

function seen({ r, g, b }: Color, eye: Matrix): [number, number, number] {
  const [x = 0, y = 0, z = 0] = eye.map(([p, q, s]) => Math.min(1, Math.max(0, p * r + q * g + s * b)));
  return oklab(x, y, z);
}

const cast = (base: Color): Color[] => [0, 1, 2, 3].map((player) => companionColor(base, player, new Color()));

describe("companionColor", () => {
  it("leaves the first player's colour to the show", () => {
    for (const base of BASES) expect(cast(new Color(base))[0]?.equals(new Color(base))).toBe(true);
  });

  it.each(BASES.flatMap((base) => Object.keys(EYES).map((eye) => [base, eye] as const)))(
    "beside %s tells four players apart for eyes with %s",
    (base, eye) => {
      const colors = cast(new Color(base)).map((color) => seen(color, EYES[eye] ?? []));
      for (let i = 0; i < colors.length; i++) {
        for (let j = 0; j < i; j++) {
          const [a, b] = [colors[i] ?? [], colors[j] ?? []];
          // A just noticeable difference is about 0.02.
          expect(Math.hypot(...a.map((part, k) => part - (b[k] ?? 0)))).toBeGreaterThan(0.07);
        }
      }
    },
  );

  it("is what a screen can show, from black to white", () => {
    for (const base of [...BASES, "#000000", "#FFFFFF", "#FF0000", "#00FF00", "#0000FF"]) {
      for (const color of cast(new Color(base))) {
        for (const part of color.toArray()) expect(part).toBeGreaterThanOrEqual(-1e-3);
        for (const part of color.toArray()) expect(part).toBeLessThanOrEqual(1.001);
      }
    }
  });
});

describe("paneColor", () => {
  it("can be read on the page's panes, whatever colour blocks have", () => {
    for (const base of [...BASES, "#000000", "#101080"]) {
      const { r, g, b } = paneColor(new Color(base), new Color());
      const luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
      // WCAG's contrast to the ink of the panes, #14171f.
      expect((luminance + 0.05) / (0.0086 + 0.05)).toBeGreaterThan(4.5);
    }
  });
});
