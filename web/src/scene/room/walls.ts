/** Walls, panelling and tall windows. */

import {
  BufferGeometry,
  type Color,
  Group,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  UniformsLib,
  UniformsUtils,
  type Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { PANELLING, ROOM, WINDOWS } from "./plan";
import { createSurface, type RoomLight } from "./surface";
import { WINDOW_PATTERN } from "./window-light";

/** Plaster above wooden panelling, both darker toward the corners and the ceiling. */
const WALL_COLOR = /* glsl */ `
float aboveRail = smoothstep(${(PANELLING - 0.004).toFixed(3)}, ${(PANELLING + 0.004).toFixed(3)}, vRoomPlace.y);
float along = abs(vRoomPlace.z - (${ROOM.back.toFixed(2)})) < 0.02 ? vRoomPlace.x : vRoomPlace.z;
float board = abs(fract(along / 0.14) - 0.5) * 0.14;
float groove = 1.0 - smoothstep(0.0, 0.004 + fwidth(along), 0.07 - board);
float rail = smoothstep(0.05, 0.045, abs(vRoomPlace.y - ${(PANELLING - 0.02).toFixed(3)}));
vec3 wood = vec3(0.08, 0.045, 0.027) * (1.0 - 0.4 * groove * (1.0 - rail)) * (1.0 + 0.35 * rail);
vec3 plaster = diffuseColor.rgb;
diffuseColor.rgb = mix(wood, plaster, aboveRail);
float corner = smoothstep(0.0, 2.6, ${ROOM.halfWidth.toFixed(2)} - abs(vRoomPlace.x) + 0.8);
float ceiling = 1.0 - 0.6 * smoothstep(1.6, ${ROOM.height.toFixed(2)}, vRoomPlace.y);
diffuseColor.rgb *= mix(0.45, 1.0, corner) * ceiling;
`;

function wall(width: number, height: number, turn: number, x: number, z: number): BufferGeometry {
  return new PlaneGeometry(width, height).rotateY(turn).translate(x, height / 2, z);
}

function createWindows(toKey: Vector3, keyColor: Color, daylight: { value: number }): Mesh {
  const panes: BufferGeometry[] = [];
  const height = WINDOWS.head - WINDOWS.sill;
  for (const side of [-1, 1]) {
    for (let i = 0; i < WINDOWS.count; i++) {
      const pane = new PlaneGeometry(WINDOWS.width + 0.16, height + 0.16).rotateY((-side * Math.PI) / 2);
      const z = WINDOWS.first + i * WINDOWS.pitch;
      panes.push(pane.translate(side * (ROOM.halfWidth - 0.012), (WINDOWS.head + WINDOWS.sill) / 2, z));
    }
  }
  const material = new ShaderMaterial({
    fog: true,
    uniforms: {
      ...UniformsUtils.clone(UniformsLib.fog),
      toKey: { value: toKey },
      keyColor: { value: keyColor },
      daylight,
    },
    vertexShader: /* glsl */ `
      #include <common>
      #include <fog_pars_vertex>
      varying vec3 vPlace;
      void main() {
        vPlace = position;
        vec4 mvPosition = viewMatrix * vec4(position, 1.0);
        gl_Position = projectionMatrix * mvPosition;
        #include <fog_vertex>
      }`,
    fragmentShader: /* glsl */ `
      #include <common>
      #include <fog_pars_fragment>
      varying vec3 vPlace;
      uniform vec3 toKey;
      uniform vec3 keyColor;
      uniform float daylight;
      ${WINDOW_PATTERN}
      void main() {
        float glass = windowPattern(vPlace.zy, 0.004 + 0.5 * length(fwidth(vPlace.zy)));
        float height = (vPlace.y - ${WINDOWS.sill.toFixed(2)}) / ${height.toFixed(2)};
        float sunny = smoothstep(-0.1, 0.4, toKey.x * sign(vPlace.x));
        vec3 dusk = mix(vec3(0.52, 0.42, 0.36), vec3(0.16, 0.24, 0.42), smoothstep(0.0, 0.75, height)) * daylight;
        vec3 sun = keyColor * mix(0.34, 0.62, height) + vec3(0.1, 0.12, 0.16) * daylight;
        vec3 light = mix(dusk, sun, sunny);
        gl_FragColor = vec4(mix(vec3(0.05, 0.03, 0.02), light, glass), 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
        #include <fog_fragment>
      }`,
  });
  const mesh = new Mesh(mergeGeometries(panes), material);
  mesh.name = "windows";
  return mesh;
}

/**
 * @param keyColor the key's colour times its intensity: what the sun's windows shine with.
 * @param daylight how strongly the sky stands in the windows. Both are shared and kept up to date.
 */
export function createWalls(light: RoomLight, keyColor: Color, daylight: { value: number }): Group {
  const depth = ROOM.front - ROOM.back;
  const middle = (ROOM.front + ROOM.back) / 2;
  const surfaces = mergeGeometries([
    wall(2 * ROOM.halfWidth, ROOM.height, 0, 0, ROOM.back),
    wall(2 * ROOM.halfWidth, ROOM.height, Math.PI, 0, ROOM.front),
    wall(depth, ROOM.height, Math.PI / 2, -ROOM.halfWidth, middle),
    wall(depth, ROOM.height, -Math.PI / 2, ROOM.halfWidth, middle),
    new PlaneGeometry(2 * ROOM.halfWidth, depth).rotateX(Math.PI / 2).translate(0, ROOM.height, middle),
  ]);
  const material = createSurface({ color: 0xb9ad9a, roughness: 0.92, metalness: 0, envMapIntensity: 0.3 }, light, {
    color: WALL_COLOR,
    roughness: "roughnessFactor = mix(0.5, 0.95, aboveRail);",
  });
  const walls = new Mesh(surfaces, material);
  walls.name = "walls";
  walls.receiveShadow = true;
  const group = new Group();
  group.add(walls, createWindows(light.toKey, keyColor, daylight));
  return group;
}
