/** Floor and walls: a standard material that takes the key through the windows and the other lights gently. */

import {
  type Color,
  MeshStandardMaterial,
  type MeshStandardMaterialParameters,
  ShaderChunk,
  type Vector3,
} from "three";

import { ROOM } from "./plan";
import { WINDOW_LIGHT } from "./window-light";

/** Shares of fill and rim that reach the room: they are for the player. */
const FILL_SHARE = 0.35;
const RIM_SHARE = 0.12;

const LIGHTS = ShaderChunk.lights_fragment_begin.replace(
  "getDirectionalLightInfo( directionalLight, directLight );",
  `getDirectionalLightInfo( directionalLight, directLight );
   directLight.color *= roomShare( UNROLLED_LOOP_INDEX );`,
);

const PLACE = /* glsl */ `
#ifdef USE_INSTANCING
vRoomPlace = (modelMatrix * instanceMatrix * vec4(transformed, 1.0)).xyz;
#else
vRoomPlace = (modelMatrix * vec4(transformed, 1.0)).xyz;
#endif
`;

const SHARE = /* glsl */ `
varying vec3 vRoomPlace;
uniform vec3 toKey;
${WINDOW_LIGHT}
uniform vec3 backWash;
float keyShare;
// Lamps in a row at the foot of the back wall, 1.46 m apart: scallops that run together as they rise.
vec3 washLight(vec3 place) {
  float away = place.z - (${ROOM.back.toFixed(2)});
  float lamp = 0.5 + 0.5 * cos(place.x * 4.3036);
  float height = smoothstep(0.0, 2.4, place.y);
  float spread = mix(0.25 + 1.1 * lamp * lamp, 0.8, height);
  return backWash * spread * exp(-0.42 * place.y) * exp(-1.1 * away) / (0.6 + 2.0 * away);
}
float roomShare(int light) {
  return light == 0 ? keyShare : (light == 1 ? ${FILL_SHARE.toFixed(3)} : ${RIM_SHARE.toFixed(3)});
}
`;

/** The light that the room takes in its own way; shared, and kept up to date by the lights. */
export interface RoomLight {
  /** Unit vector to the key. */
  readonly toKey: Vector3;
  /** The back wash's colour times its intensity. */
  readonly washed: Color;
}

export interface SurfaceShader {
  /** GLSL before main; `vRoomPlace` is the place in the world, metres. */
  readonly declarations?: string;
  /** GLSL that may change `diffuseColor`. */
  readonly color?: string;
  /** GLSL that may change `roughnessFactor`. */
  readonly roughness?: string;
  /** GLSL that may change `outgoingLight`; `normal` and `geometryViewDir` are in view space. */
  readonly light?: string;
  readonly uniforms?: Record<string, { value: unknown }>;
}

/** A surface of the room. */
export function createSurface(
  parameters: MeshStandardMaterialParameters,
  light: RoomLight,
  shader: SurfaceShader,
): MeshStandardMaterial {
  const material = new MeshStandardMaterial(parameters);
  material.onBeforeCompile = (program) => {
    Object.assign(
      program.uniforms,
      { toKey: { value: light.toKey }, backWash: { value: light.washed } },
      shader.uniforms,
    );
    program.vertexShader = program.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vRoomPlace;")
      .replace("#include <project_vertex>", `#include <project_vertex>\n${PLACE}`);
    program.fragmentShader = program.fragmentShader
      .replace("#include <common>", `#include <common>\n${SHARE}\n${shader.declarations ?? ""}`)
      .replace("#include <color_fragment>", `#include <color_fragment>\n${shader.color ?? ""}`)
      .replace("#include <roughnessmap_fragment>", `#include <roughnessmap_fragment>\n${shader.roughness ?? ""}`)
      .replace("#include <lights_fragment_begin>", `keyShare = windowLight(vRoomPlace, toKey);\n${LIGHTS}`)
      .replace(
        "#include <opaque_fragment>",
        `outgoingLight += diffuseColor.rgb * washLight(vRoomPlace);\n${shader.light ?? ""}\n#include <opaque_fragment>`,
      );
  };
  const source = [shader.declarations, shader.color, shader.roughness, shader.light].join();
  material.customProgramCacheKey = () => source;
  return material;
}
