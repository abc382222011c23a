/** All that stands still in the room, as one mesh: what hangs on the walls, the risers, the instruments at rest. */

import { BoxGeometry, type BufferGeometry, Mesh } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { instrumentsAtRest } from "./instruments-at-rest";
import { painted } from "./painted";
import { RISERS } from "./plan";
import { createSurface, type RoomLight } from "./surface";
import { wallFittings } from "./wall-fittings";

/** Steps for the rows at the back, each with a paler edge. */
function risers(): BufferGeometry[] {
  return RISERS.flatMap(({ left, right, back, front, height }) => {
    const [width, depth] = [right - left, front - back];
    const x = (left + right) / 2;
    return [
      painted(new BoxGeometry(width, height, depth).translate(x, height / 2, (front + back) / 2), 0x38251a),
      painted(new BoxGeometry(width, 0.03, 0.04).translate(x, height - 0.013, front), 0x7a5a3c),
    ];
  });
}

export function createFittings(light: RoomLight): Mesh {
  const parts = [...risers(), ...wallFittings(), ...instrumentsAtRest()];
  const geometry = mergeGeometries(parts);
  for (const part of parts) part.dispose();
  const material = createSurface({ vertexColors: true, roughness: 0.55, metalness: 0, envMapIntensity: 0.35 }, light, {
    // What is dark is lacquered or blackened: smoother than wood and linen.
    roughness: "roughnessFactor = mix(0.3, 0.72, smoothstep(0.0, 0.05, dot(diffuseColor.rgb, vec3(0.33))));",
  });
  const mesh = new Mesh(geometry, material);
  mesh.name = "fittings";
  mesh.receiveShadow = true;
  return mesh;
}
