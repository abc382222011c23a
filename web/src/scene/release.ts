/** Give back the graphics card's memory of what leaves the scene. */

import { type Material, Mesh, type Object3D, Texture } from "three";

function releaseMaterial(material: Material): void {
  for (const value of Object.values(material)) if (value instanceof Texture) value.dispose();
  material.dispose();
}

/** Release the geometries, materials and textures below an object. */
export function release(object: Object3D): void {
  object.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    const mesh = node as Mesh;
    mesh.geometry.dispose();
    for (const material of [mesh.material].flat()) releaseMaterial(material);
  });
}
