/** The played part as blocks on a staff that scrolls with the song's time. */

import {
  AdditiveBlending,
  DoubleSide,
  Group,
  InstancedBufferAttribute,
  type InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
} from "three";

import type { ScoreView } from "../score";
import { createBlockGeometry, createCardGeometry, createLineGeometry } from "./block-geometry";
import { LANE, createLaneUniforms } from "./lane";
import { type Chunk, layOut } from "./layout";
import { BLOCK_FRAGMENT, BLOCK_VERTEX, HALO_FRAGMENT, HALO_VERTEX, LINE_FRAGMENT, LINE_VERTEX } from "./shaders";
import { STAFF_LINES } from "./staff";

/** Longer than any piece, seconds: the staff has no end. */
const FOREVER = 1e6;

/** Order of drawing, after the room: staff, light, and the blocks over their own light. */
const ORDER = { lines: 1, halos: 2, blocks: 3 } as const;

interface DrawnChunk {
  readonly chunk: Chunk;
  readonly object: Group;
}

function withColumns(
  shape: InstancedBufferGeometry,
  name: string,
  columns: InstancedBufferAttribute,
): InstancedBufferGeometry {
  const geometry = shape.clone();
  geometry.setAttribute(name, columns);
  geometry.instanceCount = columns.count;
  return geometry;
}

export class NoteBlocks {
  readonly object = new Group();
  readonly uniforms = { ...createLaneUniforms(), pixelAngle: { value: 0.001 } };
  readonly #shapes: { readonly block: InstancedBufferGeometry; readonly card: InstancedBufferGeometry };
  readonly #line = createLineGeometry(1);
  readonly #materials: { readonly block: ShaderMaterial; readonly halo: ShaderMaterial; readonly line: ShaderMaterial };
  #chunks: DrawnChunk[] = [];

  /** @param stations cross-sections along a block, by how much its bend should show. */
  constructor(stations: number) {
    this.object.name = "blocks";
    this.#shapes = { block: createBlockGeometry(stations), card: createCardGeometry(stations) };
    const common = { uniforms: this.uniforms, transparent: true };
    this.#materials = {
      block: new ShaderMaterial({ ...common, fog: true, vertexShader: BLOCK_VERTEX, fragmentShader: BLOCK_FRAGMENT }),
      halo: new ShaderMaterial({
        ...common,
        side: DoubleSide,
        blending: AdditiveBlending,
        depthWrite: false,
        vertexShader: HALO_VERTEX,
        fragmentShader: HALO_FRAGMENT,
      }),
      line: new ShaderMaterial({
        ...common,
        fog: true,
        side: DoubleSide,
        depthWrite: false,
        vertexShader: LINE_VERTEX,
        fragmentShader: LINE_FRAGMENT,
      }),
    };
    const staff = new Float32Array(STAFF_LINES.flatMap((step) => [-FOREVER, FOREVER, step, step]));
    const lines = withColumns(createLineGeometry(6 * stations), "line", new InstancedBufferAttribute(staff, 4));
    this.object.add(this.#mesh(lines, "line", ORDER.lines));
  }

  #mesh(geometry: InstancedBufferGeometry, material: "block" | "halo" | "line", order: number): Mesh {
    const mesh = new Mesh(geometry, this.#materials[material]);
    // Only the shader knows where the blocks are.
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    mesh.renderOrder = order;
    return mesh;
  }

  /** Lay the blocks out anew. */
  setScore(score: ScoreView): void {
    this.#clear();
    this.#chunks = layOut(score).map((chunk) => {
      const object = new Group();
      if (chunk.notes.length > 0) {
        const notes = new InstancedBufferAttribute(chunk.notes, 4);
        object.add(
          this.#mesh(withColumns(this.#shapes.block, "note", notes), "block", ORDER.blocks),
          this.#mesh(withColumns(this.#shapes.card, "note", notes), "halo", ORDER.halos),
        );
      }
      if (chunk.lines.length > 0) {
        const lines = new InstancedBufferAttribute(chunk.lines, 4);
        object.add(this.#mesh(withColumns(this.#line, "line", lines), "line", ORDER.lines));
      }
      this.object.add(object);
      return { chunk, object };
    });
  }

  /** Scroll to a song time; what lies wholly beyond the lane's ends is not drawn. */
  scroll(songTime: number): void {
    const { uniforms } = this;
    uniforms.songTime.value = songTime;
    const speed = Math.max(uniforms.speed.value, 1e-3);
    const toBell = uniforms.arrangement.value < 0.5;
    const from = songTime - (toBell ? 0 : LANE.below.past) / speed;
    const to = songTime + (toBell ? LANE.bell.sight : LANE.below.sight) / speed;
    for (const { chunk, object } of this.#chunks) object.visible = chunk.endS >= from && chunk.startS <= to;
  }

  #clear(): void {
    for (const { object } of this.#chunks) {
      this.object.remove(object);
      for (const mesh of object.children) if (mesh instanceof Mesh) (mesh as Mesh).geometry.dispose();
    }
    this.#chunks = [];
  }

  dispose(): void {
    this.#clear();
    for (const material of Object.values(this.#materials)) material.dispose();
    for (const shape of Object.values(this.#shapes)) shape.dispose();
    this.#line.dispose();
  }
}
