/** A varnished wooden floor that takes light and shadow, and gives a little of the room back. */

import { Mesh, type MeshStandardMaterial, PlaneGeometry } from "three";

import { FOOT_SHADE, type Feet } from "./feet";
import type { FloorMirror } from "./mirror";
import { ROOM } from "./plan";
import { createSurface, type RoomLight } from "./surface";

const PLANKS = /* glsl */ `
float plankHash(vec2 cell) {
  return fract(sin(dot(cell, vec2(127.1, 311.7))) * 43758.5453);
}
float plankTone;
float plankSeam;
void layPlanks(vec2 place) {
  const vec2 size = vec2(0.115, 1.9);
  float strip = floor(place.x / size.x);
  vec2 at = vec2(place.x / size.x - strip, place.y / size.y + plankHash(vec2(strip, 3.0)));
  float plank = floor(at.y);
  vec2 edge = min(fract(at), 1.0 - fract(at)) * size;
  vec2 width = fwidth(place) + 0.0008;
  vec2 seam = 1.0 - smoothstep(vec2(0.0), vec2(0.0016) + width, edge);
  // Seams finer than a pixel fade into the tone.
  vec2 seen = clamp(0.004 / width, 0.0, 1.0);
  plankSeam = max(seam.x * seen.x, seam.y * seen.y);
  plankTone = plankHash(vec2(strip, plank));
}
`;

const REFLECTION = /* glsl */ `
uniform sampler2D mirrorImage;
uniform mat4 mirrorMatrix;
vec3 reflectedRoom(vec3 place, float roughness) {
  vec4 at = mirrorMatrix * vec4(place, 1.0);
  vec2 uv = at.xy / at.w;
  // Varnish is not quite flat: the image blurs, more along the view than across it.
  vec2 reach = vec2(0.004, 0.018) * roughness;
  vec3 sum = vec3(0.0);
  for (int tap = -2; tap <= 2; tap++) {
    sum += textureLod(mirrorImage, uv + reach * float(tap), 1.0 + 2.2 * roughness).rgb;
  }
  return sum * 0.2;
}
`;

export interface Floor {
  readonly mesh: Mesh<PlaneGeometry, MeshStandardMaterial>;
}

/** @param mirror what the floor reflects, or null for the room's environment alone. */
export function createFloor(light: RoomLight, mirror: FloorMirror | null, feet: Feet): Floor {
  const depth = ROOM.front - ROOM.back;
  const geometry = new PlaneGeometry(2 * ROOM.halfWidth, depth).rotateX(-Math.PI / 2);
  geometry.translate(0, 0, (ROOM.front + ROOM.back) / 2);
  const material = createSurface(
    {
      color: 0x6b4630,
      roughness: mirror === null ? 0.5 : 0.62,
      metalness: 0,
      envMapIntensity: mirror === null ? 0.45 : 0.7,
    },
    light,
    {
      declarations: PLANKS + FOOT_SHADE + (mirror === null ? "" : REFLECTION),
      color: `layPlanks(vRoomPlace.xz);
        diffuseColor.rgb *= (0.82 + 0.3 * plankTone) * (1.0 - 0.55 * plankSeam) * footShade(vRoomPlace);`,
      roughness: "roughnessFactor = clamp(roughnessFactor + 0.14 * (plankTone - 0.5) + 0.2 * plankSeam, 0.05, 1.0);",
      ...(mirror === null
        ? { uniforms: feet.uniforms }
        : {
            light: `float grazing = 1.0 - saturate(dot(normal, geometryViewDir));
              float glint = (0.035 + 0.55 * pow(grazing, 4.0)) * (1.0 - plankSeam);
              outgoingLight += glint * reflectedRoom(vRoomPlace, 0.55 + 0.5 * plankTone);`,
            uniforms: {
              ...feet.uniforms,
              mirrorImage: { value: mirror.texture },
              mirrorMatrix: { value: mirror.matrix },
            },
          }),
    },
  );
  const mesh = new Mesh(geometry, material);
  mesh.receiveShadow = true;
  mesh.name = "floor";
  return { mesh };
}
