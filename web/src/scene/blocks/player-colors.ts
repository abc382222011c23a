/** Colours of the other players' blocks where a show gives only the first player's: apart in hue and in lightness. */

import type { Color } from "three";

/**
 * By the place in the cast: turn of the hue, degrees, and how much darker (negative: lighter), on OKLab's scale of
 * lightness from 0 to 1, beside most colours and beside one that is nearly white. Lightness differs too, for who sees two
 * of the hues as one.
 */
const COMPANIONS: readonly (readonly [turn: number, darker: number, besideWhite: number])[] = [
  [0, 0, 0],
  [180, 0.17, 0.17],
  [-75, 0.31, 0.31],
  [75, -0.14, 0.46],
];

/** The least colour that a companion has: a grey would otherwise have grey ones. */
const MIN_CHROMA = 0.09;
const [DARKEST, LIGHTEST] = [0.26, 0.93];

type Triple = [number, number, number];

/** Linear sRGB to OKLab (Ottosson 2020). */
export function oklab(r: number, g: number, b: number): Triple {
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

/** OKLab to linear sRGB. */
function linear(lightness: number, a: number, b: number): Triple {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

/** How light a colour of blocks, from 0 to 1, is on a dark pane: light enough to be read, and in the same order. */
const [PANE_DARKEST, PANE_SHARE] = [0.62, 0.34];

const isShown = (part: number): boolean => part >= -1e-4 && part <= 1.0001;

/** The fullest colour of a lightness and a hue that a screen has, up to a chroma; linear sRGB. */
function shownColor(light: number, hue: number, chroma: number): Triple {
  let shown = linear(light, chroma * Math.cos(hue), chroma * Math.sin(hue));
  for (let full = chroma; !shown.every(isShown);) {
    full *= 0.92;
    shown = linear(light, full * Math.cos(hue), full * Math.sin(hue));
  }
  return shown;
}

/** A blocks' colour as it is read on the page's dark panes; set in `into`. */
export function paneColor(blocks: Color, into: Color): Color {
  const [lightness, a, b] = oklab(blocks.r, blocks.g, blocks.b);
  const light = PANE_DARKEST + PANE_SHARE * lightness;
  return into.setRGB(...shownColor(light, Math.atan2(b, a), Math.hypot(a, b)));
}

/**
 * The colour of a player's blocks beside the first player's.
 *
 * @param base the first player's, linear sRGB.
 * @param player place in the cast; 0 gives the same colour.
 * @param into is set.
 */
export function companionColor(base: Color, player: number, into: Color): Color {
  const [turn, darker, besideWhite] = COMPANIONS[player % COMPANIONS.length] ?? [0, 0, 0];
  if (turn === 0) return into.copy(base);
  const [lightness, a, b] = oklab(base.r, base.g, base.b);
  const hue = Math.atan2(b, a) + (turn * Math.PI) / 180;
  // Beside a dark colour there is no room for a darker one: there the signs are turned over, by and by.
  const sign = Math.min(1, Math.max(-1, (lightness - 0.45) / 0.08));
  const whiteness = Math.min(1, Math.max(0, (lightness - 0.76) / 0.1));
  const less = darker + (besideWhite - darker) * whiteness;
  const light = Math.min(LIGHTEST, Math.max(DARKEST, lightness - sign * less));
  return into.setRGB(...shownColor(light, hue, Math.max(MIN_CHROMA, Math.hypot(a, b))));
}
