/** What metal in the lab reflects, and what lights it: a warm window, a dark floor, a cool room. */

import {
  BackSide,
  BoxGeometry,
  Color,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  PMREMGenerator,
  Scene,
  type Texture,
  type WebGLRenderer,
} from "three";

import { INK } from "./palette";

/** Pixels of a reflection's side: metal here is dull, and drawing in software is slow. */
const SIDE = 32;

function panel(colour: string, strength: number, size: readonly number[], place: readonly number[]): Mesh {
  const material = new MeshBasicMaterial({ color: new Color(colour).multiplyScalar(strength) });
  const mesh = new Mesh(new BoxGeometry(size[0], size[1], size[2]), material);
  mesh.position.set(place[0] ?? 0, place[1] ?? 0, place[2] ?? 0);
  return mesh;
}

function reflected(renderer: WebGLRenderer): Texture {
  const room = new Scene();
  const walls = new Mesh(new BoxGeometry(12, 7, 12), new MeshBasicMaterial({ color: "#6d6a6c", side: BackSide }));
  room.add(
    walls,
    panel("#ffd9a0", 9, [0.1, 4, 4], [-5.6, 1.2, 1]),
    panel("#ffe9c8", 5, [3, 0.1, 2], [1, 3.3, 0]),
    panel("#9db4dd", 2.2, [0.1, 3, 5], [5.6, 1, -1]),
    panel("#15110d", 1, [12, 0.1, 12], [0, -3.3, 0]),
  );
  const generator = new PMREMGenerator(renderer);
  const texture = generator.fromScene(room, 0, 0.1, 100, { size: SIDE }).texture;
  generator.dispose();
  return texture;
}

/** Light a scene; returns what releases it again. */
export function surround(scene: Scene, renderer: WebGLRenderer): () => void {
  const texture = reflected(renderer);
  const key = new DirectionalLight("#ffdfb0", 2.2);
  key.position.set(-3, 4, 3);
  const rim = new DirectionalLight("#9db4dd", 1.2);
  rim.position.set(3, 2, -4);
  scene.background = new Color(INK);
  scene.environment = texture;
  scene.add(key, rim, new HemisphereLight("#aebbd6", "#4a3a28", 0.9));
  return () => texture.dispose();
}
