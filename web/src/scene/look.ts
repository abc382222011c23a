/** How the players look: lit as cloth and metal are or drawn in flat tones, and what the brass is finished with. */

import {
  Color,
  type DataTexture,
  type Material,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  type PerspectiveCamera,
} from "three";

import { createOutline, createTones, drawSurface, outlineUniforms } from "./toon";

/** Choices of `look/style` and `trumpet/finish`, by their index. */
const TOON = 1;
const SILVER = 1;

const SILVER_PLATE = new Color(0.9, 0.89, 0.86);

interface Surface {
  readonly mesh: Mesh;
  readonly physical: MeshStandardMaterial;
  drawn: Material | null;
  outline: Mesh | null;
}

/** Metal whose colour the finish decides. */
interface Plated {
  readonly color: Color;
  readonly lacquer: Color;
}

export class PlayerLook {
  #surfaces: Surface[] = [];
  #plated: Plated[] = [];
  #tones: DataTexture | null = null;
  readonly #lens = outlineUniforms();
  #style = 0;
  #finish = 0;

  /** Dress these models; what was dressed before is let go. */
  setModels(models: readonly Object3D[]): void {
    this.release();
    for (const model of models) {
      model.traverse((node) => {
        if (!(node instanceof Mesh)) return;
        const { material } = node as Mesh;
        if (!(material instanceof MeshStandardMaterial)) return;
        this.#surfaces.push({ mesh: node as Mesh, physical: material, drawn: null, outline: null });
        this.#plate(material);
      });
    }
    const [style, finish] = [this.#style, this.#finish];
    this.#style = this.#finish = 0;
    this.setStyle(style);
    this.setFinish(finish);
  }

  #plate(material: Material): void {
    if (!(material instanceof MeshStandardMaterial) || !/^brass/i.test(material.name)) return;
    if (this.#plated.some(({ color }) => color === material.color)) return;
    this.#plated.push({ color: material.color, lacquer: material.color.clone() });
  }

  /** @param style index among the choices of `look/style`. */
  setStyle(style: number): void {
    if (style === this.#style) return;
    this.#style = style;
    const toon = style === TOON;
    if (toon) this.#draw();
    for (const { mesh, physical, drawn, outline } of this.#surfaces) {
      mesh.material = toon && drawn !== null ? drawn : physical;
      if (outline !== null) outline.visible = toon;
    }
  }

  /** Make the drawn surfaces and their outlines, the first time that they are wanted. */
  #draw(): void {
    const tones = (this.#tones ??= createTones());
    const known = new Map<MeshStandardMaterial, Material>();
    const finish = this.#finish;
    this.setFinish(0);
    for (const surface of this.#surfaces) {
      if (surface.drawn !== null) continue;
      const { mesh, physical } = surface;
      surface.drawn = known.get(physical) ?? drawSurface(physical, tones);
      known.set(physical, surface.drawn);
      this.#plate(surface.drawn);
      surface.outline = createOutline(mesh, physical, this.#lens);
      if (surface.outline !== null) mesh.add(surface.outline);
    }
    this.setFinish(finish);
  }

  /** @param finish index among the choices of `trumpet/finish`. */
  setFinish(finish: number): void {
    if (finish === this.#finish) return;
    this.#finish = finish;
    for (const { color, lacquer } of this.#plated) color.copy(finish === SILVER ? SILVER_PLATE : lacquer);
  }

  /** Keep the outlines' width even through this lens. */
  follow(camera: PerspectiveCamera): void {
    this.#lens.aspect.value = camera.aspect;
    this.#lens.reach.value = 2 * Math.tan((camera.fov * Math.PI) / 360);
  }

  /** Let the drawn surfaces go; the models are released by whoever holds them. */
  release(): void {
    for (const { mesh, physical, drawn, outline } of this.#surfaces) {
      mesh.material = physical;
      drawn?.dispose();
      if (outline === null) continue;
      mesh.remove(outline);
      (outline.material as Material).dispose();
    }
    this.#tones?.dispose();
    this.#tones = null;
    this.#surfaces = [];
    this.#plated = [];
  }
}
