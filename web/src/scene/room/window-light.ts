/** Sunlight through the windows, as GLSL: which points of the room the key reaches. */

import { ROOM, WINDOWS } from "./plan";

const f = (value: number): string => value.toFixed(4);

/** `float windowPattern(vec2 zy, float soft)`: 1 inside a pane, 0 on wall and bars, with edges `soft` metres wide. */
export const WINDOW_PATTERN = /* glsl */ `
float softBand(float distanceInside, float soft) {
  return smoothstep(-soft, soft, distanceInside);
}
float windowPattern(vec2 zy, float soft) {
  float cell = (zy.x - ${f(WINDOWS.first)}) / ${f(WINDOWS.pitch)};
  float nearest = clamp(floor(cell + 0.5), 0.0, ${f(WINDOWS.count - 1)});
  float z = zy.x - ${f(WINDOWS.first)} - nearest * ${f(WINDOWS.pitch)};
  float y = zy.y - ${f(WINDOWS.sill)};
  float height = ${f(WINDOWS.head - WINDOWS.sill)};
  float inside = softBand(${f(WINDOWS.width / 2)} - abs(z), soft) * softBand(height * 0.5 - abs(y - height * 0.5), soft);
  vec2 pane = vec2(${f(WINDOWS.width / WINDOWS.panes[0])}, height / ${f(WINDOWS.panes[1])});
  vec2 within = vec2(z + ${f(WINDOWS.width / 2)}, y);
  vec2 bar = abs(within - pane * floor(within / pane + 0.5));
  // A penumbra wider than the bar only dims it.
  float depth = min(1.0, ${f(WINDOWS.bar)} / (2.0 * soft));
  vec2 clear = 1.0 - depth * (1.0 - smoothstep(vec2(-soft), vec2(soft), bar - ${f(WINDOWS.bar / 2)}));
  return inside * clear.x * clear.y;
}
`;

/** `float playerShift(vec3 toKey)`: by how much the sun's row of windows stands off along z, so that the player is in its light. */
export const PLAYER_SHIFT = /* glsl */ `
float playerShift(vec3 toKey) {
  float crossing = 0.1 + toKey.z * ${f(ROOM.halfWidth)} / max(abs(toKey.x), 0.05);
  float cell = (crossing - ${f(WINDOWS.first)}) / ${f(WINDOWS.pitch)};
  return (cell - floor(cell + 0.5)) * ${f(WINDOWS.pitch)};
}
`;

/** `float windowLight(vec3 place, vec3 toKey)`: the share of the key that comes to a place of the room. */
export const WINDOW_LIGHT = /* glsl */ `
${WINDOW_PATTERN}
${PLAYER_SHIFT}
float windowLight(vec3 place, vec3 toKey) {
  float side = toKey.x < 0.0 ? -1.0 : 1.0;
  float along = (side * ${f(ROOM.halfWidth)} - place.x) / (side * max(abs(toKey.x), 0.05) );
  vec3 crossing = place + toKey * along;
  crossing.z -= playerShift(toKey);
  float pattern = windowPattern(crossing.zy, 0.012 + 0.010 * along);
  // A key that comes from the front is a lamp in the room, not the sun.
  return mix(1.0, pattern, smoothstep(0.12, 0.35, abs(toKey.x)));
}
`;
