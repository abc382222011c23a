/** The dark under a shoe, where neither window nor room shines: it stands on the floor in every tier. */

import { type Object3D, Vector3 } from "three";

/** Feet that are shaded: four players'. */
const MAX_FEET = 8;

/** Far below: shades nothing. */
const NOWHERE = -100;

export const FOOT_SHADE = /* glsl */ `
uniform vec3 feet[${MAX_FEET}];
float footShade(vec3 place) {
  float open = 1.0;
  for (int i = 0; i < ${MAX_FEET}; i++) {
    vec2 away = place.xz - feet[i].xz;
    float lifted = clamp((feet[i].y - 0.12) / 0.25, 0.0, 1.0);
    float near = dot(away, away);
    open *= 1.0 - (1.0 - lifted) * step(0.0, feet[i].y + 1.0) * (0.5 * exp(-near / 0.012) + 0.22 * exp(-near / 0.09));
  }
  return open;
}
`;

/** Joints whose shade is drawn, and how far ahead of the ankle the shoe's middle is, metres. */
export const FOOT_JOINTS = ["leftFoot", "rightFoot"] as const;
const AHEAD = 0.07;

export class Feet {
  readonly uniforms = { feet: { value: Array.from({ length: MAX_FEET }, () => new Vector3(0, NOWHERE, 0)) } };
  #nodes: readonly Object3D[] = [];

  set(nodes: readonly Object3D[]): void {
    this.#nodes = nodes.slice(0, MAX_FEET);
    for (const foot of this.uniforms.feet.value) foot.set(0, NOWHERE, 0);
  }

  /** Follow the feet; after the scene's world matrices are up to date. */
  follow(): void {
    for (let i = 0; i < this.#nodes.length; i++) {
      const node = this.#nodes[i];
      const foot = this.uniforms.feet.value[i];
      if (node === undefined || foot === undefined) continue;
      foot.setFromMatrixPosition(node.matrixWorld);
      foot.z += AHEAD;
    }
  }
}
