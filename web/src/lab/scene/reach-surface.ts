/** The plane of a reach map: what is reached is tinted, what is not is hatched. */

import {
  CanvasTexture,
  DoubleSide,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  PlaneGeometry,
  SRGBColorSpace,
} from "three";

import type { ReachCells } from "../../generated/lab";
import { DUSK, RIBBON } from "./palette";

/** Pixels of the picture's side, about. */
const SIDE = 640;
const HATCH = 18;

function paint(cells: ReachCells): HTMLCanvasElement {
  const pixels = Math.ceil(SIDE / Math.max(cells.columns, cells.rows));
  const canvas = document.createElement("canvas");
  canvas.width = cells.columns * pixels;
  canvas.height = cells.rows * pixels;
  const context = canvas.getContext("2d");
  if (context === null) return canvas;
  const { width, height } = canvas;
  context.strokeStyle = RIBBON;
  context.globalAlpha = 0.34;
  context.lineWidth = 1.4;
  context.beginPath();
  for (let x = -height; x < width; x += HATCH) {
    context.moveTo(x, height);
    context.lineTo(x + height, 0);
  }
  context.stroke();
  context.globalAlpha = 0.26;
  context.fillStyle = DUSK;
  for (let row = 0; row < cells.rows; row++) {
    for (let column = 0; column < cells.columns; column++) {
      if (cells.reached[row * cells.columns + column] !== "1") continue;
      // Row 0 is the lowest; a canvas counts from above.
      const x = column * pixels;
      const y = (cells.rows - 1 - row) * pixels;
      context.clearRect(x, y, pixels, pixels);
      context.fillRect(x, y, pixels, pixels);
    }
  }
  return canvas;
}

export class ReachSurface {
  readonly mesh = new Mesh(
    new PlaneGeometry(1, 1),
    new MeshBasicMaterial({ transparent: true, side: DoubleSide, depthWrite: false }),
  );

  constructor() {
    this.mesh.matrixAutoUpdate = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = -1;
  }

  set(cells: ReachCells | null): void {
    this.mesh.visible = cells !== null;
    if (cells === null) return;
    const texture = new CanvasTexture(paint(cells));
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = NearestFilter;
    this.mesh.material.map?.dispose();
    this.mesh.material.map = texture;
    this.mesh.material.needsUpdate = true;
    const [rx, ry, rz] = cells.right.map((step) => step * cells.columns) as [number, number, number];
    const [ux, uy, uz] = cells.up.map((step) => step * cells.rows) as [number, number, number];
    const middle = cells.corner.map(
      (corner, i) =>
        corner + ((cells.right[i] ?? 0) * (cells.columns - 1)) / 2 + ((cells.up[i] ?? 0) * (cells.rows - 1)) / 2,
    ) as [number, number, number];
    this.mesh.matrix.copy(
      new Matrix4().set(rx, ux, 0, middle[0], ry, uy, 0, middle[1], rz, uz, 1, middle[2], 0, 0, 0, 1),
    );
    this.mesh.matrixWorldNeedsUpdate = true;
  }
}
