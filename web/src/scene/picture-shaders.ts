/** Passes over the whole picture, as GLSL. */

/** The widest blur disc's radius, as a share of the picture's height. */
const WIDEST = 0.016;
const TAPS = 44;

export const QUAD_VERTEX = /* glsl */ `
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

/** Half the size; the first time only what is brighter than the threshold, with a soft knee. */
export const DOWN_FRAGMENT = /* glsl */ `
uniform sampler2D picture;
uniform vec2 texel;
uniform float threshold;
varying vec2 vUv;
vec3 bright(vec2 uv) {
  vec3 light = min(texture2D(picture, uv).rgb, vec3(24.0));
  if (threshold < 0.0) return light;
  float peak = max(light.r, max(light.g, light.b));
  float knee = 0.5 * threshold + 1e-4;
  float soft = clamp(peak - threshold + knee, 0.0, 2.0 * knee);
  float over = max(soft * soft / (4.0 * knee), peak - threshold) / max(peak, 1e-4);
  // Single sparks weigh less, so that they do not flicker.
  return light * over / (1.0 + 0.25 * peak * over);
}
void main() {
  vec3 sum = bright(vUv) * 4.0;
  for (int i = 0; i < 4; i++) {
    vec2 corner = vec2(i < 2 ? -1.0 : 1.0, mod(float(i), 2.0) < 0.5 ? -1.0 : 1.0);
    sum += bright(vUv + corner * texel);
  }
  gl_FragColor = vec4(sum / 8.0, 1.0);
}`;

/** The smaller picture, spread over the larger one. */
export const UP_FRAGMENT = /* glsl */ `
uniform sampler2D picture;
uniform vec2 texel;
varying vec2 vUv;
void main() {
  vec3 sum = vec3(0.0);
  for (int y = -1; y <= 1; y++) {
    for (int x = -1; x <= 1; x++) {
      float weight = (2.0 - abs(float(x))) * (2.0 - abs(float(y)));
      sum += weight * texture2D(picture, vUv + vec2(x, y) * texel).rgb;
    }
  }
  gl_FragColor = vec4(sum * (0.85 / 16.0), 1.0);
}`;

/**
 * Focus, bloom, tone. The blur gathers a spiral of neighbours, each as far as its own disc reaches (after Dennis
 * Gustafsson, "Bokeh depth of field in a single pass", 2018).
 */
export const COMPOSITE_FRAGMENT = /* glsl */ `
#include <common>
#include <packing>
uniform sampler2D picture;
uniform sampler2D bloomed;
uniform float bloom;
uniform float aspect;
varying vec2 vUv;
#ifdef FOCUS
uniform sampler2D depth;
uniform vec2 range;
uniform float focus;
uniform float blur;
float distanceAt(vec2 uv) {
  return -perspectiveDepthToViewZ(texture2D(depth, uv).x, range.x, range.y);
}
float discAt(float away) {
  return min(0.5 * blur * abs(away - focus) / away, ${WIDEST.toFixed(4)});
}
vec3 focused() {
  vec3 sum = min(texture2D(picture, vUv).rgb, vec3(2.5));
  float away = distanceAt(vUv);
  float own = discAt(away);
  float turn = 6.2832 * rand(gl_FragCoord.xy);
  float count = 1.0;
  float edge = 0.0012;
  for (int i = 0; i < ${TAPS}; i++) {
    float reach = sqrt((float(i) + 0.5) / ${TAPS.toFixed(1)}) * ${WIDEST.toFixed(4)};
    float angle = turn + float(i) * 2.39996;
    vec2 uv = vUv + reach * vec2(cos(angle) / aspect, sin(angle));
    float there = distanceAt(uv);
    float disc = discAt(there);
    // What is behind does not spill over what is sharp before it.
    if (there > away) disc = min(disc, 2.0 * own);
    // Sparks would leave dots.
    vec3 light = min(texture2D(picture, uv).rgb, vec3(1.3));
    sum += mix(sum / count, light, smoothstep(reach - edge, reach + edge, disc));
    count += 1.0;
  }
  return sum / count;
}
#endif
void main() {
  vec3 light;
#ifdef FOCUS
  light = blur > 0.0 ? focused() : texture2D(picture, vUv).rgb;
#else
  light = texture2D(picture, vUv).rgb;
#endif
  if (bloom > 0.0) light += bloom * 0.2 * texture2D(bloomed, vUv).rgb;
  gl_FragColor = vec4(light, 1.0);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  gl_FragColor.rgb += (rand(gl_FragCoord.xy) - 0.5) / 255.0;
}`;
