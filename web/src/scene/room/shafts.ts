/** Air in the sun: faint sheets of light from the windows into the room, as thick as the show's fog. */

import {
  AdditiveBlending,
  BufferGeometry,
  type Color,
  DoubleSide,
  Float32BufferAttribute,
  Mesh,
  ShaderMaterial,
  type Vector3,
} from "three";

import { ROOM, WINDOWS } from "./plan";
import { PLAYER_SHIFT } from "./window-light";

const SHEETS = 2;
const PIECES = 10;

/** `position`: which window, which sheet across it (−0.5…0.5), how high (0…1); `depth`: how far into the room (0…1). */
function createSheets(): BufferGeometry {
  const position: number[] = [];
  const depth: number[] = [];
  const index: number[] = [];
  for (let window = 0; window < WINDOWS.count; window++) {
    for (let sheet = 0; sheet < SHEETS; sheet++) {
      const first = depth.length;
      for (let piece = 0; piece <= PIECES; piece++) {
        for (const height of [0, 1]) {
          position.push(window, (sheet + 0.5) / SHEETS - 0.5, height);
          depth.push(piece / PIECES);
        }
      }
      for (let i = first; i < first + 2 * PIECES; i += 2) index.push(i, i + 2, i + 1, i + 1, i + 2, i + 3);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(position, 3));
  geometry.setAttribute("depth", new Float32BufferAttribute(depth, 1));
  geometry.setIndex(index);
  return geometry;
}

export interface Shafts {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  /** The fog's density, to be kept up to date. */
  readonly density: { value: number };
}

/** @param keyColor the key's colour times its intensity. */
export function createShafts(toKey: Vector3, keyColor: Color): Shafts {
  const density = { value: 0 };
  const material = new ShaderMaterial({
    uniforms: { toKey: { value: toKey }, keyColor: { value: keyColor }, density },
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    blending: AdditiveBlending,
    vertexShader: /* glsl */ `
      attribute float depth;
      uniform vec3 toKey;
      varying vec2 vAcross;
      varying float vFacing;
      varying float vNear;
      ${PLAYER_SHIFT}
      void main() {
        float side = toKey.x < 0.0 ? -1.0 : 1.0;
        float into = ${(2 * ROOM.halfWidth * 0.85).toFixed(2)} / max(abs(toKey.x), 0.3);
        vec3 place = vec3(
          side * ${(ROOM.halfWidth - 0.05).toFixed(2)},
          mix(${WINDOWS.sill.toFixed(2)}, ${WINDOWS.head.toFixed(2)}, position.z),
          ${WINDOWS.first.toFixed(2)} + position.x * ${WINDOWS.pitch.toFixed(2)} + position.y * ${WINDOWS.width.toFixed(2)} + playerShift(toKey)
        ) - toKey * depth * into;
        vAcross = vec2(depth, position.z);
        vec3 toEye = cameraPosition - place;
        vFacing = abs(dot(normalize(toEye), normalize(cross(toKey, vec3(0.0, 1.0, 0.0)))));
        vNear = smoothstep(0.2, 1.6, length(toEye));
        gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      #include <common>
      uniform vec3 toKey;
      uniform vec3 keyColor;
      uniform float density;
      varying vec2 vAcross;
      varying float vFacing;
      varying float vNear;
      void main() {
        float edge = smoothstep(0.0, 0.12 + 0.25 * vAcross.x, vAcross.y) * smoothstep(1.0, 0.88 - 0.25 * vAcross.x, vAcross.y);
        float fade = (1.0 - vAcross.x) * smoothstep(0.0, 0.04, vAcross.x);
        float sunny = smoothstep(0.12, 0.35, abs(toKey.x));
        float light = edge * fade * vNear * sunny * smoothstep(0.05, 0.5, vFacing) * min(density * 0.14, 0.02);
        // Added to the finished picture, so small that its eight bits need a grain.
        float grain = (rand(gl_FragCoord.xy) - 0.5) / 510.0;
        gl_FragColor = vec4(max(vec3(0.0), keyColor * light + grain * step(0.0001, light)), 1.0);
      }`,
  });
  const mesh = new Mesh(createSheets(), material);
  mesh.name = "shafts";
  mesh.frustumCulled = false;
  mesh.renderOrder = 4;
  return { mesh, density };
}
