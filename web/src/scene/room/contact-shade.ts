/** The dark under what stands in the room, where neither window nor room shines: soft patches just above the floor. */

import { InstancedMesh, Matrix4, PlaneGeometry, ShaderMaterial } from "three";

/** Middle, width and depth of a patch, and the height of what it lies on, metres. */
export type Patch = readonly [x: number, z: number, width: number, depth: number, y?: number];

/** Above the floor by so much that no depth buffer confuses the two, metres. */
const CLEARANCE = 0.004;

export function createContactShade(patches: readonly Patch[]): InstancedMesh {
  const material = new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    vertexShader: /* glsl */ `
      varying vec2 vAcross;
      void main() {
        vAcross = 2.0 * uv - 1.0;
        gl_Position = projectionMatrix * viewMatrix * modelMatrix * instanceMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      varying vec2 vAcross;
      void main() {
        vec2 inside = 1.0 - smoothstep(0.25, 1.0, abs(vAcross));
        gl_FragColor = vec4(0.012, 0.007, 0.004, 0.62 * inside.x * inside.y);
      }`,
  });
  const mesh = new InstancedMesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material, patches.length);
  const matrix = new Matrix4();
  patches.forEach(([x, z, width, depth, y = 0], i) =>
    mesh.setMatrixAt(i, matrix.makeScale(width, 1, depth).setPosition(x, y + CLEARANCE, z)),
  );
  mesh.name = "contact shade";
  mesh.computeBoundingSphere();
  return mesh;
}
