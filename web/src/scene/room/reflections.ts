/** What the brass sees: bright tall windows, a dark floor, a warm wall. Rendered once, then only looked up. */

import {
  BackSide,
  BoxGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  PMREMGenerator,
  Scene,
  type Texture,
  Vector3,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";

import { ROOM, WINDOWS } from "./plan";

/** Radiance, linear: the sun's windows are far brighter than white. */
const RADIANCE = {
  floor: new Color(0.045, 0.026, 0.016),
  sunOnFloor: new Color(1.7, 1.02, 0.52),
  ceiling: new Color(0.2, 0.165, 0.13),
  warmWall: new Color(0.46, 0.31, 0.2),
  coolWall: new Color(0.14, 0.16, 0.2),
  backWall: new Color(0.34, 0.24, 0.165),
  sunOnWall: new Color(2.6, 1.6, 0.85),
  frontWall: new Color(0.1, 0.095, 0.1),
  sunWindow: new Color(17, 13.2, 8.8),
  skyWindow: new Color(1.5, 2.0, 2.9),
} as const;

/** From where it is seen: the bell. */
const EYE = new Vector3(0, 1.3, 0.4);

function panel(width: number, height: number, color: Color): Mesh {
  return new Mesh(
    new PlaneGeometry(width, height),
    new MeshBasicMaterial({ color, toneMapped: false, side: DoubleSide }),
  );
}

function box(): Mesh {
  const depth = ROOM.front - ROOM.back;
  const geometry = new BoxGeometry(2 * ROOM.halfWidth, ROOM.height, depth);
  const sides = [
    RADIANCE.coolWall,
    RADIANCE.warmWall,
    RADIANCE.ceiling,
    RADIANCE.floor,
    RADIANCE.frontWall,
    RADIANCE.backWall,
  ];
  const materials = sides.map((color) => new MeshBasicMaterial({ color, toneMapped: false, side: BackSide }));
  const mesh = new Mesh(geometry, materials);
  mesh.position.set(0, ROOM.height / 2, (ROOM.front + ROOM.back) / 2);
  return mesh;
}

/** Each pane alone, so that a curve of brass draws the bars between them. */
function windows(side: -1 | 1, color: Color): Group {
  const group = new Group();
  const [across, up] = WINDOWS.panes;
  const width = WINDOWS.width / across;
  const height = (WINDOWS.head - WINDOWS.sill) / up;
  for (let i = 0; i < WINDOWS.count; i++) {
    for (let column = 0; column < across; column++) {
      for (let row = 0; row < up; row++) {
        const pane = panel(width - WINDOWS.bar, height - WINDOWS.bar, color);
        const z = WINDOWS.first + i * WINDOWS.pitch + (column - (across - 1) / 2) * width;
        pane.position.set(side * (ROOM.halfWidth - 0.02), WINDOWS.sill + (row + 0.5) * height, z);
        pane.rotation.y = (-side * Math.PI) / 2;
        group.add(pane);
      }
    }
  }
  return group;
}

function sunPatches(): Group {
  const group = new Group();
  for (const x of [-2.3, -0.7, 0.9]) {
    const onFloor = panel(1.0, 2.2, RADIANCE.sunOnFloor);
    onFloor.rotation.set(-Math.PI / 2, 0, -0.5);
    onFloor.position.set(x, 0.01, -1.4 - x * 0.5);
    const onWall = panel(0.9, 1.5, RADIANCE.sunOnWall);
    onWall.position.set(x - 1, 1.5, ROOM.back + 0.02);
    group.add(onFloor, onWall);
  }
  return group;
}

/** The room as light, the sun at the player's left as in the room's rest. */
function createRadianceScene(): Scene {
  const scene = new Scene();
  scene.add(box(), windows(1, RADIANCE.sunWindow), windows(-1, RADIANCE.skyWindow), sunPatches());
  return scene;
}

export class RoomReflections {
  readonly #size: number;
  #target: WebGLRenderTarget | null = null;

  /** @param size texels along a side of each face. */
  constructor(size: number) {
    this.#size = size;
  }

  /** Render it; again after the drawing context was lost. */
  render(renderer: WebGLRenderer): Texture {
    this.#target?.dispose();
    const scene = createRadianceScene();
    const generator = new PMREMGenerator(renderer);
    this.#target = generator.fromScene(scene, 0.008, 0.05, 30, { size: this.#size, position: EYE });
    generator.dispose();
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const mesh = node as Mesh;
      mesh.geometry.dispose();
      for (const material of [mesh.material].flat()) material.dispose();
    });
    return this.#target.texture;
  }

  dispose(): void {
    this.#target?.dispose();
  }
}
