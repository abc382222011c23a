/** The blocks, their halos and the staff's lines, as GLSL. */

import { BLOCK } from "./block-geometry";
import { LANE, LANE_PLACE, MAX_LANES } from "./lane";
import { DRUM_PIECES } from "./staff";

const f = (value: number): string => value.toFixed(4);

/** Where a note's block begins and ends on the lane; what was played into the bell is gone. */
const NOTE_SPAN = /* glsl */ `
attribute vec4 note;
/** Which piece is struck, from 1; 0 for none. */
attribute float piece;
uniform vec3 pieces[${MAX_LANES * DRUM_PIECES.length}];
/** A place of a note's block: a hit comes down from the staff to what it strikes. */
Place notePlace(float ahead) {
  Place place = lanePlace(ahead, note.z);
  if (piece < 0.5 || arrangement > 0.5) return place;
  vec3 into = pieces[int(lane + 0.5) * ${DRUM_PIECES.length} + int(piece - 0.5)];
  place.point.xz = mix(into.xz, place.point.xz, smoothstep(0.06, ${f(LANE.kit.dive)}, ahead));
  place.point.y = mix(into.y + 0.02, place.point.y, smoothstep(0.0, ${f(0.7 * LANE.kit.dive)}, ahead));
  return place;
}
/** Whether a note sounds: what is not played never does. */
float sounding() {
  return step(-0.5, note.w) * step(note.x, songTime + 1e-4) * step(songTime + 1e-4, note.x + note.y);
}
bool noteSpan(out float start, out float end) {
  start = max((note.x - songTime) * speed + laneGap(), laneStart() + laneGap());
  float full = (note.x + note.y - songTime) * speed + laneGap();
  // A breath between two blocks, so that repeated notes stay two.
  end = min(full - min(0.012, 0.15 * note.y * speed), laneEnd());
  return end > start + 0.0015;
}
`;

export const BLOCK_VERTEX = /* glsl */ `
#include <common>
#include <fog_pars_vertex>
${LANE_PLACE}
${NOTE_SPAN}
attribute float inset;
uniform vec3 colors[${MAX_LANES}];
uniform vec3 soundingColors[${MAX_LANES}];
varying float vLane;
varying vec3 vColor;
varying vec3 vSoundingColor;
varying vec3 vFace;
varying vec2 vInside;
varying float vLength;
varying float vSounding;
varying float vMask;
varying float vSight;
varying vec3 vNormalWorld;
varying vec3 vToEye;
void main() {
  float start, end;
  vec4 mvPosition = vec4(0.0, 0.0, 0.0, 1.0);
  vLane = lane;
  vColor = colors[int(lane + 0.5)];
  vSoundingColor = soundingColors[int(lane + 0.5)];
  if (noteSpan(start, end)) {
    float extent = end - start;
    float ahead = mix(start, end, position.x);
    Place place = notePlace(ahead);
    float depth = inset * min(1.0, extent / (4.0 * ${f(BLOCK.edge)})) * place.scale;
    vec3 point = place.point + place.along * depth + (place.up * position.y + place.out_ * position.z) * place.scale;
    mvPosition = viewMatrix * vec4(point, 1.0);
    gl_Position = projectionMatrix * mvPosition;
    vFace = normal;
    vInside = vec2((ahead - start + depth) / place.scale, position.y);
    vLength = extent / place.scale;
    vSounding = sounding();
    vMask = note.w;
    vSight = place.sight;
    vNormalWorld = normalize(place.along * normal.x + place.up * normal.y + place.out_ * normal.z);
    vToEye = cameraPosition - point;
  } else {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    vFace = vNormalWorld = vToEye = vec3(0.0, 0.0, 1.0);
    vInside = vec2(0.0);
    vLength = vSounding = vMask = vSight = 0.0;
  }
  #include <fog_vertex>
}
`;

/** Colours of the marks: paper, and one for each valve (linear sRGB of #F4EFE6, #C23B3B, #4C6A9A, #D9A441). */
const MARKS = /* glsl */ `
const vec3 PAPER = vec3(0.905, 0.863, 0.791);
const vec3 INK = vec3(0.007, 0.0086, 0.0137);
vec3 valveColor(int valve) {
  return valve == 0 ? vec3(0.539, 0.0437, 0.0437) : (valve == 1 ? vec3(0.0723, 0.1441, 0.3231) : vec3(0.6939, 0.3712, 0.0528));
}
`;

export const BLOCK_FRAGMENT = /* glsl */ `
#include <common>
#include <fog_pars_fragment>
uniform float opacity;
uniform float glow;
uniform vec3 toKey;
varying float vLane;
varying vec3 vColor;
varying vec3 vSoundingColor;
varying vec3 vFace;
varying vec2 vInside;
varying float vLength;
varying float vSounding;
varying float vMask;
varying float vSight;
varying vec3 vNormalWorld;
varying vec3 vToEye;
${MARKS}
void main() {
  float alpha = opacity * vSight * smoothstep(0.22, 0.5, length(vToEye));
  if (alpha < 0.004) discard;
  vec3 normal = normalize(vNormalWorld);
  vec3 eye = normalize(vToEye);
  bool playable = vMask > -0.5;
  bool marked = playable && vMask < 63.5;
  vec3 color = vColor;
  vec3 soundingColor = vSoundingColor;
  vec3 body = playable ? color : mix(color, vec3(dot(color, vec3(0.3333))), 0.7) * 0.5;

  // From the edge of the face inward, metres.
  float fromEnds = min(vInside.x, vLength - vInside.x);
  float fromSides = ${f(BLOCK.height / 2)} - abs(vInside.y);
  float inward = min(fromEnds, fromSides);
  float facing = smoothstep(0.6, 0.9, abs(vFace.z));
  float core = smoothstep(0.0, ${f(BLOCK.height / 2)}, inward);
  float pixel = max(fwidth(vInside.y), 1e-5);

  // A ribbon of tinted glass with little light in it: quiet until it sounds, and still seen before window and board.
  float rim = pow(1.0 - abs(dot(normal, eye)), 3.0);
  float lamp = 0.5 + 0.5 * dot(normal, toKey);
  vec3 quiet = body * (0.34 + 0.2 * lamp + 0.1 * core) + vec3(1.0, 0.92, 0.8) * 0.12 * rim;
  // A fine bright line along both edges holds its shape.
  float brim = 1.0 - smoothstep(0.0016, 0.0016 + max(0.002, pixel), fromSides);
  quiet = mix(quiet, body * 0.85 + 0.05, 0.65 * brim * facing);

  // Lit from within, in its own colour: deeper toward the edge, as in a lantern, and never so bright that it turns white.
  float warmth = glow / (1.0 + 0.5 * glow);
  float peak = max(max(soundingColor.r, soundingColor.g), max(soundingColor.b, 0.05));
  vec3 deep = soundingColor * soundingColor / peak;
  vec3 lit = mix(deep, mix(deep, soundingColor, 0.6), core);
  lit *= 0.5 + 0.95 * warmth * (0.6 + 0.4 * core);
  // Brightest where it is heard: at the bell.
  lit *= 1.0 + 0.35 * exp(-vInside.x / 0.06);
  vec3 surface = mix(quiet, lit, vSounding);
  alpha *= mix(0.62 + 0.25 * brim + 0.13 * rim, 1.0, vSounding);
  // A dark hair about the face: the ribbon keeps its shape before a bright window and in its own light.
  float line = 1.0 - smoothstep(0.0005, 0.0005 + max(0.0008, pixel), inward);
  surface *= 1.0 - 0.55 * line * facing;

  bool struck = vMask > 15.5 && vMask < 31.5;
  if (struck) {
    // One disc for a hand, a ring for a foot; the right side gold, the left blue, as R and L have on a sheet.
    float away = length(vInside - vec2(0.5 * vLength, 0.0));
    float size = min(0.0115, 0.42 * vLength);
    bool right = mod(vMask + 0.5, 2.0) > 1.0;
    bool hand = mod(floor((vMask + 0.5) / 2.0), 2.0) > 0.5;
    float ground = 1.0 - smoothstep(-pixel, pixel, away - size - 0.003);
    float disc = 1.0 - smoothstep(-pixel, pixel, away - size);
    float hole = hand ? 0.0 : 1.0 - smoothstep(-pixel, pixel, away - 0.55 * size);
    surface = mix(surface, INK, 0.9 * ground * facing);
    surface = mix(surface, right ? 1.35 * valveColor(2) : 2.6 * valveColor(1), disc * (1.0 - hole) * facing);
    alpha = mix(alpha, opacity * vSight, ground * facing);
  } else if (marked) {
    // Three valves as beads in the ribbon, the first nearest the bell: a pressed one is light in a quiet ribbon and
    // ink in one that sounds; one that is up is a point.
    float apart = min(0.0235, 0.27 * vLength);
    float radius = min(0.0098, 0.4 * apart);
    for (int valve = 0; valve < 3; valve++) {
      float away = length(vInside - vec2(apart * (0.78 + float(valve)), 0.0));
      bool down = mod(floor((vMask + 0.5) / exp2(float(valve))), 2.0) > 0.5;
      float size = down ? radius : 0.3 * radius;
      float bead = (1.0 - smoothstep(-pixel, pixel, away - size)) * facing;
      float ring = (1.0 - smoothstep(-pixel, pixel, away - size - 0.0022)) * facing;
      vec3 mark = mix(mix(PAPER, 1.5 * valveColor(valve), 0.25), INK, vSounding);
      surface = mix(surface, mix(INK, lit, vSounding), (down ? 0.8 : 0.0) * ring);
      surface = mix(surface, mark, (down ? 1.0 : 0.75) * bead);
      alpha = mix(alpha, opacity * vSight, down ? ring : bead);
    }
  }
  // A line along the block for the second player, two for the third: hue does not speak alone.
  float grooves = floor(vLane + 0.5);
  float across = vInside.y / 0.011 + 0.5 * (grooves - 1.0);
  float fromGroove = 0.011 * abs(across - clamp(floor(across + 0.5), 0.0, grooves - 1.0));
  float behindMarks = step(0.031, vInside.x) * step(vInside.x, vLength - 0.006);
  float groove = (1.0 - smoothstep(0.0009, 0.0009 + pixel, fromGroove)) * step(0.5, grooves) * behindMarks;
  surface = mix(surface, INK, 0.6 * groove * facing);
  // What is not played is an empty frame, faint before what is.
  if (!playable) {
    float frame = 1.0 - smoothstep(0.003, 0.003 + pixel, inward);
    surface = mix(surface, PAPER, 0.6 * frame * facing);
    alpha *= mix(0.1, 0.45, frame);
  }
  gl_FragColor = vec4(surface, alpha);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  #include <fog_fragment>
}
`;

/** Light about a sounding block: a card that faces the eye, added to the picture. */
export const HALO_VERTEX = /* glsl */ `
#include <common>
${LANE_PLACE}
${NOTE_SPAN}
uniform float glow;
uniform vec3 soundingColors[${MAX_LANES}];
varying vec3 vSoundingColor;
varying vec2 vFrom;
varying float vSight;
const float REACH = 0.16;
void main() {
  float start, end;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vSoundingColor = soundingColors[int(lane + 0.5)];
  vFrom = vec2(0.0);
  vSight = 0.0;
  if (sounding() > 0.5 && glow > 0.0 && noteSpan(start, end)) {
    float ahead = clamp(mix(start, end, position.x), start, end);
    Place place = notePlace(ahead);
    vec3 eye = normalize(cameraPosition - place.point);
    vec3 up = normalize(cross(eye, place.along));
    up *= sign(dot(up, place.up) + 1e-4);
    vec3 along = cross(up, eye);
    along *= sign(dot(along, place.along) + 1e-4);
    vec3 point = place.point + (along * position.z + up * position.y) * REACH * max(place.scale, 0.5) + eye * 0.02;
    vFrom = position.zy;
    vSight = place.sight;
    gl_Position = projectionMatrix * viewMatrix * vec4(point, 1.0);
  }
}
`;

export const HALO_FRAGMENT = /* glsl */ `
#include <common>
uniform float glow;
uniform float opacity;
varying vec3 vSoundingColor;
varying vec2 vFrom;
varying float vSight;
void main() {
  float falloff = max(0.0, 1.0 - length(vFrom));
  float light = falloff * falloff * falloff * glow / (1.0 + 0.35 * glow) * 0.11 * opacity * max(vSight, 0.35);
  gl_FragColor = vec4(vSoundingColor * light, 1.0);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}
`;

/** Staff, ledger and bar lines: thin bands, a little wider than a hair from afar. */
export const LINE_VERTEX = /* glsl */ `
#include <common>
#include <fog_pars_vertex>
${LANE_PLACE}
attribute vec4 line;
uniform float pixelAngle;
varying float vSight;
varying float vBar;
varying float vThin;
varying float vOff;
void main() {
  vec4 mvPosition = vec4(0.0, 0.0, 0.0, 1.0);
  float start = max((line.x - songTime) * speed, laneStart());
  float end = min((line.y - songTime) * speed, laneEnd());
  bool bar = line.z != line.w;
  vBar = bar ? 1.0 : 0.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vSight = vThin = vOff = 0.0;
  if (bar ? (start <= end + 1e-5 && (line.x - songTime) * speed >= laneStart()) : start < end) {
    float overhang = bar || line.y - line.x > 1e5 ? 0.0 : 0.018;
    float ahead = mix(start - overhang * step(laneStart() + overhang, start), min(end + overhang, laneEnd()), position.x);
    Place place = lanePlace(ahead, mix(line.z, line.w, position.x));
    float away = distance(cameraPosition, place.point);
    // Never thinner than a pixel: fainter instead.
    float wanted = (bar ? 0.0022 : 0.0016) * place.scale;
    float width = max(wanted, 0.6 * pixelAngle * away);
    vThin = wanted / width;
    vec3 across = bar ? place.along : place.up;
    // Three times as wide as the line: its dark edges lie on either side.
    vOff = 6.0 * position.y;
    vec3 point = place.point + across * position.y * 3.0 * max(width, pixelAngle * away);
    mvPosition = viewMatrix * vec4(point, 1.0);
    gl_Position = projectionMatrix * mvPosition;
    vSight = place.sight * smoothstep(0.2, 0.5, away);
  }
  #include <fog_vertex>
}
`;

export const LINE_FRAGMENT = /* glsl */ `
#include <common>
#include <fog_pars_fragment>
uniform float opacity;
varying float vSight;
varying float vBar;
varying float vThin;
varying float vOff;
${MARKS}
void main() {
  float line = 1.0 - smoothstep(0.5, 1.4, abs(vOff));
  float shade = 0.5 * (1.0 - smoothstep(0.8, 3.0, abs(vOff)));
  float alpha = max(line * vThin * mix(0.6, 0.8, vBar), shade * sqrt(vThin));
  gl_FragColor = vec4(mix(INK, PAPER, line), vSight * alpha * min(1.0, opacity * 1.2));
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  #include <fog_fragment>
}
`;
