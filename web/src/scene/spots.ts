/** Stage spots: a light with a soft cone, and the haze that shows it in the air. */

import {
  AdditiveBlending,
  BufferGeometry,
  Color,
  Float32BufferAttribute,
  FrontSide,
  Mesh,
  ShaderMaterial,
  SpotLight,
  Vector3,
} from "three";

/** As many as the show has parameters for: `lights/spots/1` and on. */
export const SPOT_COUNT = 3;

/** A cone ends on the floor, or here, metres. */
const LONGEST = 9;

/** The hull stands off the light's own edge, which is soft. */
const HULL = 1.25;

/** And it goes on under the floor, so that its open end is never seen. */
const BELOW = 1.7;
const AROUND = 24;

/** A cone's hull: `position` holds where around it (cosine, sine) and how far along its axis (0…1). */
function createHull(): BufferGeometry {
  const position: number[] = [];
  const index: number[] = [];
  for (let i = 0; i < AROUND; i++) {
    const turn = (2 * Math.PI * i) / AROUND;
    for (const along of [0, 1]) position.push(Math.cos(turn), Math.sin(turn), along);
  }
  for (let i = 0; i < AROUND; i++) {
    const a = 2 * i;
    const b = (a + 2) % (2 * AROUND);
    index.push(a, b, a + 1, b, b + 1, a + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(position, 3));
  geometry.setIndex(index);
  return geometry;
}

const HULL_VERTEX = /* glsl */ `
uniform vec3 apex;
uniform vec3 axis;
uniform float reach;
uniform float spread;
varying vec3 vPlace;
void main() {
  vec3 side = normalize(cross(abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), axis));
  vec3 other = cross(axis, side);
  float along = position.z * reach * ${BELOW.toFixed(2)};
  float radius = (0.05 + along * spread) * ${HULL.toFixed(2)};
  vPlace = apex + axis * along + (side * position.x + other * position.y) * radius;
  gl_Position = projectionMatrix * viewMatrix * vec4(vPlace, 1.0);
}`;

/**
 * Light that the haze scatters to the eye along a ray: by how near the ray passes to the cone's axis, and by the
 * cone's width there.
 */
const HULL_FRAGMENT = /* glsl */ `
#include <common>
uniform vec3 apex;
uniform vec3 axis;
uniform float reach;
uniform float spread;
uniform float softness;
uniform vec3 color;
uniform float songTime;
varying vec3 vPlace;
void main() {
  vec3 ray = normalize(vPlace - cameraPosition);
  vec3 from = cameraPosition - apex;
  float across = dot(ray, axis);
  float crossing = max(1.0 - across * across, 0.02);
  float along = clamp((dot(axis, from) - across * dot(ray, from)) / crossing, 0.0, reach);
  vec3 onAxis = apex + axis * along;
  vec3 place = cameraPosition + ray * max(0.0, dot(onAxis - cameraPosition, ray));
  float radius = 0.05 + along * spread;
  float off = distance(place, onAxis) / radius;
  float beam = exp(-mix(3.4, 1.9, softness) * off * off) * smoothstep(${HULL.toFixed(2)}, 0.7, off);
  // Light thins as the cone widens, so that whom it shines at is not veiled. And slow smoke.
  vec3 drift = place * vec3(2.1, 2.7, 2.3) + vec3(0.11, -0.17, 0.07) * songTime;
  float smoke = 0.8 + 0.2 * sin(drift.x + 1.7 * sin(drift.y)) * sin(drift.y + 1.3 * sin(drift.z + drift.x));
  float fade = smoothstep(reach, 0.75 * reach, along) * smoothstep(0.6, 4.6, distance(place, cameraPosition));
  float light = beam * smoke * fade * min(0.0075 / ((0.1 + radius) * (0.1 + radius)), 0.14) / sqrt(crossing);
  float grain = (rand(gl_FragCoord.xy) - 0.5) / 400.0;
  gl_FragColor = vec4(max(vec3(0.0), color * light + grain * step(0.0005, light)), 1.0);
}`;

export class Spot {
  readonly light = new SpotLight(0xffffff, 0, 0, 0.24, 0.6, 0);
  readonly cone: Mesh<BufferGeometry, ShaderMaterial>;
  readonly #uniforms = {
    apex: { value: new Vector3() },
    axis: { value: new Vector3(0, -1, 0) },
    reach: { value: 4 },
    spread: { value: 0.25 },
    softness: { value: 0.6 },
    color: { value: new Color(0, 0, 0) },
    songTime: { value: 0 },
  };

  constructor() {
    const material = new ShaderMaterial({
      uniforms: this.#uniforms,
      transparent: true,
      depthWrite: false,
      side: FrontSide,
      blending: AdditiveBlending,
      vertexShader: HULL_VERTEX,
      fragmentShader: HULL_FRAGMENT,
    });
    this.cone = new Mesh(createHull(), material);
    this.cone.name = "cone";
    this.cone.frustumCulled = false;
    this.cone.matrixAutoUpdate = false;
    this.cone.renderOrder = 5;
    this.cone.visible = false;
  }

  /** Follow the light with its cone. */
  arrange(haze: number, songTime: number): void {
    const { light, cone } = this;
    const { apex, axis, reach, spread, softness, color, songTime: time } = this.#uniforms;
    cone.visible = light.intensity > 0 && haze > 0;
    if (!cone.visible) return;
    apex.value.copy(light.position);
    axis.value.subVectors(light.target.position, light.position).normalize();
    const toFloor = axis.value.y < -1e-3 ? light.position.y / -axis.value.y : LONGEST;
    reach.value = Math.min(LONGEST, Math.max(0.1, toFloor));
    spread.value = Math.tan(light.angle);
    softness.value = light.penumbra;
    color.value.copy(light.color).multiplyScalar(light.intensity * haze);
    time.value = songTime;
  }
}
