/** The lanes: where a moment of the score and a height on the staff lie in the room, as GLSL. */

import { Color, UniformsLib, UniformsUtils, Vector2, Vector3 } from "three";

import { DRUM_PIECES } from "./staff";

/** Lanes that there can be, one a player. */
export const MAX_LANES = 8;

/** A number for each lane, and the same for vectors and colours. */
const perLane = <T>(make: () => T): T[] => Array.from({ length: MAX_LANES }, make);

/** Measures of both arrangements, metres unless said otherwise. */
export const LANE = {
  /** Height of one diatonic step on the staff. */
  step: 0.033,
  /** toward_bell: the ribbon leaves the bell and turns to the player's left. */
  bell: { side: 1, radius: 1.15, turn: 1.12, height: 1.32, funnel: 0.5, narrowest: 0.68, sight: 3.6 },
  /** toward_bell, to a kit: tighter, behind whoever stands before it; hits leave the staff and fall to their pieces within `dive`. */
  kit: { radius: 0.45, turn: 1.45, dive: 0.5 },
  /** lane_below: a desk before the player; the moment that sounds stands at `now`. */
  below: { now: -0.55, near: 1.05, height: 0.42, lean: 0.5, past: 0.75, sight: 2.4 },
} as const;

/** Uniforms that blocks, halos and lines share; each is set in place. */
export type LaneUniforms = ReturnType<typeof createLaneUniforms>;

export function createLaneUniforms() {
  return {
    ...UniformsUtils.clone(UniformsLib.fog),
    /** Song time, seconds. */
    songTime: { value: 0 },
    /** Metres a second. */
    speed: { value: 0.6 },
    /** 0 toward_bell, 1 lane_below. */
    arrangement: { value: 0 },
    /** Where each lane begins: the middle of the bell's mouth, or a kit's own place, in the world. */
    starts: { value: perLane(() => new Vector3(0, 1.3, 0.75)) },
    /** toward_bell: radius of each ribbon's turn, metres, and its angle, radians. */
    bends: { value: perLane(() => new Vector2(LANE.bell.radius, LANE.bell.turn)) },
    /** Where hits on each of `DRUM_PIECES` come to, in the world: of the first lane, the second and so on. */
    pieces: { value: perLane(() => DRUM_PIECES.map(() => new Vector3())).flat() },
    /** toward_bell: height to which each ribbon goes, metres; lane_below: up the desk from its middle, metres. */
    heights: { value: perLane(() => LANE.bell.height as number) },
    shifts: { value: perLane(() => 0) },
    /** How large the lanes are drawn, as a share of one that is alone. */
    laneScale: { value: 1 },
    toKey: { value: new Vector3() },
    colors: { value: perLane(() => new Color(0.1, 0.12, 0.2)) },
    soundingColors: { value: perLane(() => new Color(1, 0.6, 0.2)) },
    opacity: { value: 1 },
    glow: { value: 1 },
  };
}

const f = (value: number): string => value.toFixed(4);

/**
 * `Place lanePlace(float ahead, float step)`: a point of the staff of the lane that the mark lies in, `ahead` metres after the sounding moment, with the
 * directions along the lane, up the staff and out of it, the staff's scale there, and how much it is seen.
 */
export const LANE_PLACE = /* glsl */ `
uniform float songTime;
uniform float speed;
uniform float arrangement;
uniform vec3 starts[${MAX_LANES}];
uniform vec2 bends[${MAX_LANES}];
uniform float heights[${MAX_LANES}];
uniform float shifts[${MAX_LANES}];
uniform float laneScale;
attribute float lane;
struct Place {
  vec3 point;
  vec3 along;
  vec3 up;
  vec3 out_;
  float scale;
  float sight;
};
const float STEP = ${f(LANE.step)};
float laneStart() {
  return arrangement < 0.5 ? 0.0 : ${f(-LANE.below.past)};
}
// What sounds hangs just before the bell, where its marks can be seen.
float laneGap() {
  return arrangement < 0.5 ? 0.03 : 0.0;
}
float laneEnd() {
  return arrangement < 0.5 ? ${f(LANE.bell.sight)} : ${f(LANE.below.sight)};
}
Place lanePlace(float ahead, float step) {
  Place place;
  int number = int(lane + 0.5);
  vec3 from = starts[number];
  vec2 bend = bends[number];
  if (arrangement < 0.5) {
    float spread = smoothstep(0.0, ${f(LANE.bell.funnel)}, ahead);
    float turn = min(ahead / bend.x, bend.y);
    float straight = ahead - turn * bend.x;
    vec2 across = bend.x * vec2(1.0 - cos(turn), sin(turn)) + straight * vec2(sin(turn), cos(turn));
    place.scale = mix(${f(LANE.bell.narrowest)}, 1.0, spread) * laneScale;
    float centre = mix(from.y, heights[number], smoothstep(0.0, ${f(1.6 * LANE.bell.funnel)}, ahead));
    place.point = vec3(from.x + ${f(LANE.bell.side)} * across.x, centre + (step - 4.0) * STEP * place.scale, from.z + across.y);
    place.along = vec3(${f(LANE.bell.side)} * sin(turn), 0.0, cos(turn));
    place.up = vec3(0.0, 1.0, 0.0);
  } else {
    place.scale = laneScale;
    place.along = vec3(1.0, 0.0, 0.0);
    place.up = vec3(0.0, ${f(Math.cos(LANE.below.lean))}, ${f(-Math.sin(LANE.below.lean))});
    place.point = vec3(${f(LANE.below.now)} + ahead, ${f(LANE.below.height)}, ${f(LANE.below.near)}) + place.up * ((step - 4.0) * STEP * place.scale + shifts[number]);
  }
  place.out_ = cross(place.along, place.up);
  place.sight = smoothstep(laneEnd(), laneEnd() - 0.7, ahead) * smoothstep(laneStart() - 0.001, laneStart() + (arrangement < 0.5 ? 0.02 : 0.4), ahead);
  return place;
}
`;
