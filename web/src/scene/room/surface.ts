/** Floor and walls: a standard material that takes the key through the windows and the other lights gently. */

import { MeshStandardMaterial, type MeshStandardMaterialParameters, ShaderChunk, type Vector3 } from "three";

import { WINDOW_LIGHT } from "./window_light";

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
float keyShare;
float roomShare(int light) {
  return light == 0 ? keyShare : (light == 1 ? ${FILL_SHARE.toFixed(3)} : ${RIM_SHARE.toFixed(3)});
}
`;

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

/**
 * A surface of the room.
 *
 * @param toKey unit vector to the key, shared and kept up to date by the lights.
 */
export function createSurface(
  parameters: MeshStandardMaterialParameters,
  toKey: Vector3,
  shader: SurfaceShader,
): MeshStandardMaterial {
  const material = new MeshStandardMaterial(parameters);
  material.onBeforeCompile = (program) => {
    Object.assign(program.uniforms, { toKey: { value: toKey } }, shader.uniforms);
    program.vertexShader = program.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vRoomPlace;")
      .replace("#include <project_vertex>", `#include <project_vertex>\n${PLACE}`);
    program.fragmentShader = program.fragmentShader
      .replace("#include <common>", `#include <common>\n${SHARE}\n${shader.declarations ?? ""}`)
      .replace("#include <color_fragment>", `#include <color_fragment>\n${shader.color ?? ""}`)
      .replace("#include <roughnessmap_fragment>", `#include <roughnessmap_fragment>\n${shader.roughness ?? ""}`)
      .replace("#include <lights_fragment_begin>", `keyShare = windowLight(vRoomPlace, toKey);\n${LIGHTS}`)
      .replace("#include <opaque_fragment>", `${shader.light ?? ""}\n#include <opaque_fragment>`);
  };
  const source = [shader.declarations, shader.color, shader.roughness, shader.light].join();
  material.customProgramCacheKey = () => source;
  return material;
}
