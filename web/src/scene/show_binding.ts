/** The show's parameters: where each goes in the scene. */

import type { Color, FogExp2, Scene, WebGLRenderer } from "three";

import type { NoteBlocks } from "./blocks/blocks";
import type { StageCamera } from "./camera";
import type { ParameterIndex } from "./frame";
import type { StageLights } from "./lights";
import type { Room } from "./room";

export interface ShowTargets {
  readonly renderer: WebGLRenderer;
  readonly scene: Scene;
  readonly fog: FogExp2;
  readonly background: Color;
  readonly camera: StageCamera;
  readonly lights: StageLights;
  readonly room: Room;
  readonly blocks: NoteBlocks;
}

type Apply = (targets: ShowTargets, floats: Float32Array, index: number) => void;
type NumberApply = (targets: ShowTargets, value: number) => void;

const number =
  (apply: NumberApply): Apply =>
  (targets, floats, index) =>
    apply(targets, floats[index] ?? 0);

/** Path, length in floats, and what it sets. Vectors are in the world, metres; colours linear sRGB; angles radians. */
const PARAMETERS: readonly (readonly [path: string, length: number, apply: Apply])[] = [
  ["camera/position", 3, ({ camera }, floats, i) => camera.show.position.fromArray(floats, i)],
  ["camera/target", 3, ({ camera }, floats, i) => camera.show.target.fromArray(floats, i)],
  ["camera/fov", 1, number(({ camera }, value) => (camera.show.fov = value))],
  ["camera/roll", 1, number(({ camera }, value) => (camera.show.roll = value))],
  ["lights/key/intensity", 1, number(({ lights }, value) => (lights.key.intensity = value))],
  ["lights/key/color", 3, ({ lights }, floats, i) => lights.key.color.fromArray(floats, i)],
  ["lights/key/position", 3, ({ lights }, floats, i) => lights.key.position.fromArray(floats, i)],
  ["lights/fill/intensity", 1, number(({ lights }, value) => (lights.fill.intensity = value))],
  ["lights/fill/color", 3, ({ lights }, floats, i) => lights.fill.color.fromArray(floats, i)],
  ["lights/rim/intensity", 1, number(({ lights }, value) => (lights.rim.intensity = value))],
  ["lights/rim/color", 3, ({ lights }, floats, i) => lights.rim.color.fromArray(floats, i)],
  ["lights/rim/position", 3, ({ lights }, floats, i) => lights.rim.position.fromArray(floats, i)],
  ["lights/ambient/intensity", 1, number(({ lights }, value) => (lights.ambient.intensity = value))],
  ["lights/ambient/color", 3, ({ lights }, floats, i) => lights.ambient.color.fromArray(floats, i)],
  ["lights/environment/intensity", 1, number(({ scene }, value) => (scene.environmentIntensity = value))],
  ["stage/exposure", 1, number(({ renderer }, value) => (renderer.toneMappingExposure = value))],
  ["stage/background", 3, ({ background }, floats, i) => background.fromArray(floats, i)],
  ["stage/floor_color", 3, ({ room }, floats, i) => room.floor.material.color.fromArray(floats, i)],
  ["stage/fog/density", 1, number(({ fog }, value) => (fog.density = value))],
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

  /** Take the show's values of a frame. */
  apply(floats: Float32Array): void {
    const targets = this.#targets;
    for (const { apply, index } of this.#bound) apply(targets, floats, index);
    const { room, lights, fog, background, scene } = targets;
    lights.arrange();
    room.keyColor.copy(lights.key.color).multiplyScalar(lights.key.intensity);
    room.daylight.value = scene.environmentIntensity / RESTING_ENVIRONMENT;
    fog.color.copy(background);
    if (room.haze !== null) room.haze.value = fog.density;
  }
}
