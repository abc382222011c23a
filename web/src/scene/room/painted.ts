/** Geometry with a colour of its own, so that many things of a room are one mesh. */

import { type BufferGeometry, Color, Float32BufferAttribute } from "three";

/** Give every vertex of a geometry one colour, sRGB as in `0x4a2c1a`. */
export function painted<G extends BufferGeometry>(geometry: G, hex: number): G {
  const { r, g, b } = new Color(hex);
  const count = geometry.getAttribute("position").count;
  const colors = new Float32Array(3 * count);
  for (let i = 0; i < colors.length; i += 3) colors.set([r, g, b], i);
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  return geometry;
}
