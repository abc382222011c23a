/** The show's parameters: where each goes in the scene. */

import type { Color, FogExp2, Scene, SpotLight, WebGLRenderer } from "three";

import type { NoteBlocks } from "./blocks/blocks";
import type { StageCamera } from "./camera";
import type { ParameterIndex } from "./frame";
import type { StageLights } from "./lights";
import type { PlayerLook } from "./look";
import type { Picture } from "./picture";
import type { Room } from "./room";
import { EXPOSURE } from "./renderer";
import { SPOT_COUNT } from "./spots";

export interface ShowTargets {
  readonly renderer: WebGLRenderer;
  readonly scene: Scene;
  readonly fog: FogExp2;
  readonly background: Color;
  readonly camera: StageCamera;
  readonly lights: StageLights;
  readonly room: Room;
  readonly blocks: NoteBlocks;
  readonly picture: Picture;
  readonly look: PlayerLook;
}

type Floats = Float32Array;
type Apply = (targets: ShowTargets, floats: Floats, index: number) => void;
type NumberApply = (targets: ShowTargets, value: number) => void;

type Row = readonly [path: string, length: number, apply: Apply];

const number =
  (apply: NumberApply): Apply =>
  (targets, floats, index) =>
    apply(targets, floats[index] ?? 0);

/** What a show sets of each spot. */
function spotRows(place: number): Row[] {
  const path = `lights/spots/${place + 1}`;
  const set =
    (apply: (light: SpotLight, floats: Floats, index: number) => unknown): Apply =>
    ({ lights }, floats, index) => {
      const light = lights.spots[place]?.light;
      if (light !== undefined) apply(light, floats, index);
    };
  return [
    [`${path}/intensity`, 1, set((light, floats, i) => (light.intensity = floats[i] ?? 0))],
    [`${path}/color`, 3, set((light, floats, i) => light.color.fromArray(floats, i))],
    [`${path}/position`, 3, set((light, floats, i) => light.position.fromArray(floats, i))],
    [`${path}/target`, 3, set((light, floats, i) => light.target.position.fromArray(floats, i))],
    [`${path}/angle`, 1, set((light, floats, i) => (light.angle = floats[i] ?? 0.24))],
    [`${path}/softness`, 1, set((light, floats, i) => (light.penumbra = floats[i] ?? 0.6))],
  ];
}

/** Path, length in floats, and what it sets. Vectors are in the world, metres; colours linear sRGB; angles radians. */
const PARAMETERS: readonly Row[] = [
  ["camera/position", 3, ({ camera }, floats, i) => camera.show.position.fromArray(floats, i)],
  ["camera/target", 3, ({ camera }, floats, i) => camera.show.target.fromArray(floats, i)],
  ["camera/fov", 1, number(({ camera }, value) => (camera.show.fov = value))],
  ["camera/roll", 1, number(({ camera }, value) => (camera.show.roll = value))],
  ["camera/focus_distance", 1, number(({ picture }, value) => (picture.focusDistance = value))],
  ["camera/aperture", 1, number(({ picture }, value) => (picture.aperture = value))],
  ["lights/key/intensity", 1, number(({ lights }, value) => (lights.key.intensity = value))],
  ["lights/key/color", 3, ({ lights }, floats, i) => lights.key.color.fromArray(floats, i)],
  ["lights/key/position", 3, ({ lights }, floats, i) => lights.key.position.fromArray(floats, i)],
  ["lights/key/softness", 1, number(({ lights }, value) => (lights.softness = value))],
  ["lights/fill/intensity", 1, number(({ lights }, value) => (lights.fill.intensity = value))],
  ["lights/fill/color", 3, ({ lights }, floats, i) => lights.fill.color.fromArray(floats, i)],
  ["lights/rim/intensity", 1, number(({ lights }, value) => (lights.rim.intensity = value))],
  ["lights/rim/color", 3, ({ lights }, floats, i) => lights.rim.color.fromArray(floats, i)],
  ["lights/rim/position", 3, ({ lights }, floats, i) => lights.rim.position.fromArray(floats, i)],
  ["lights/back_wash/intensity", 1, number(({ lights }, value) => (lights.backWash.intensity = value))],
  ["lights/back_wash/color", 3, ({ lights }, floats, i) => lights.backWash.color.fromArray(floats, i)],
  ["lights/ambient/intensity", 1, number(({ lights }, value) => (lights.ambient.intensity = value))],
  ["lights/ambient/color", 3, ({ lights }, floats, i) => lights.ambient.color.fromArray(floats, i)],
  ["lights/environment/intensity", 1, number(({ scene }, value) => (scene.environmentIntensity = value))],
  ...Array.from({ length: SPOT_COUNT }, (_, place) => spotRows(place)).flat(),
  ["lights/haze", 1, number(({ lights }, value) => (lights.haze = value))],
  ["stage/exposure", 1, number(({ renderer }, value) => (renderer.toneMappingExposure = EXPOSURE * value))],
  ["stage/bloom/strength", 1, number(({ picture }, value) => (picture.bloomStrength = value))],
  ["stage/bloom/threshold", 1, number(({ picture }, value) => (picture.bloomThreshold = value))],
  ["stage/background", 3, ({ background }, floats, i) => background.fromArray(floats, i)],
  ["stage/floor_color", 3, ({ room }, floats, i) => room.floor.material.color.fromArray(floats, i)],
  ["stage/fog/density", 1, number(({ fog }, value) => (fog.density = value))],
  ["look/style", 1, number(({ look }, value) => look.setStyle(value))],
  ["trumpet/finish", 1, number(({ look }, value) => look.setFinish(value))],
  ["blocks/visible", 1, number(({ blocks }, value) => (blocks.object.visible = value > 0.5))],
  ["blocks/color", 3, ({ blocks }, floats, i) => blocks.uniforms.color.value.fromArray(floats, i)],
  ["blocks/sounding_color", 3, ({ blocks }, floats, i) => blocks.uniforms.soundingColor.value.fromArray(floats, i)],
  ["blocks/opacity", 1, number(({ blocks }, value) => (blocks.uniforms.opacity.value = value))],
  ["blocks/glow", 1, number(({ blocks }, value) => (blocks.uniforms.glow.value = value))],
  ["blocks/speed", 1, number(({ blocks }, value) => (blocks.uniforms.speed.value = value))],
  ["blocks/arrangement", 1, number(({ blocks }, value) => (blocks.uniforms.arrangement.value = value))],
];

/** The environment's intensity at which the sky in the windows is as bright as it was painted. */
const RESTING_ENVIRONMENT = 0.7;

interface Bound {
  readonly apply: Apply;
  readonly index: number;
}

/** The parameters that a session streams, bound; what it does not stream stays as the room rests. */
export class ShowBinding {
  readonly #targets: ShowTargets;
  #bound: Bound[] = [];

  constructor(targets: ShowTargets) {
    this.#targets = targets;
  }

  /** @throws LayoutError if a parameter is streamed with another length. */
  bind(parameters: ParameterIndex): void {
    this.#bound = PARAMETERS.flatMap(([path, length, apply]) => {
      const index = parameters.find(path, length);
      return index === null ? [] : [{ apply, index }];
    });
  }

  /** Take the show's values of a frame at a song time, seconds. */
  apply(floats: Float32Array, songTime: number): void {
    const targets = this.#targets;
    for (const { apply, index } of this.#bound) apply(targets, floats, index);
    const { room, lights, fog, background, scene } = targets;
    lights.arrange(songTime);
    room.keyColor.copy(lights.key.color).multiplyScalar(lights.key.intensity);
    room.daylight.value = scene.environmentIntensity / RESTING_ENVIRONMENT;
    fog.color.copy(background);
    if (room.haze !== null) room.haze.value = fog.density;
  }
}
