/** The played parts as blocks on staves that scroll with the song's time, a lane a player. */

import {
  AdditiveBlending,
  type Color,
  DoubleSide,
  Group,
  InstancedBufferAttribute,
  type InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
} from "three";

import type { ScoreView } from "../score";
import { createBlockGeometry, createCardGeometry, createLineGeometry } from "./block-geometry";
import { LANE, MAX_LANES, createLaneUniforms } from "./lane";
import { arrangeLanes } from "./lane-arrangement";
import { type Chunk, layOut } from "./layout";
import { companionColor } from "./player-colors";
import { OUTLINE_LAYER } from "../toon";
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

/** Marks of one kind: four numbers each under the name that the shader knows, and the lane that each lies in. */
interface Marks {
  readonly name: "note" | "line";
  readonly columns: InstancedBufferAttribute;
  readonly lanes: InstancedBufferAttribute;
  /** Of notes alone: what each strikes. */
  readonly pieces?: InstancedBufferAttribute;
}

function marks(name: Marks["name"], columns: Float32Array<ArrayBuffer>, lanes: Float32Array<ArrayBuffer>): Marks {
  return {
    name,
    columns: new InstancedBufferAttribute(columns, 4),
    lanes: new InstancedBufferAttribute(lanes, 1),
  };
}

function withMarks(shape: InstancedBufferGeometry, { name, columns, lanes, pieces }: Marks): InstancedBufferGeometry {
  const geometry = shape.clone();
  geometry.setAttribute(name, columns);
  geometry.setAttribute("lane", lanes);
  if (pieces !== undefined) geometry.setAttribute("piece", pieces);
  geometry.instanceCount = columns.count;
  return geometry;
}

export class NoteBlocks {
  readonly object = new Group();
  readonly uniforms = { ...createLaneUniforms(), pixelAngle: { value: 0.001 } };
  readonly #shapes: { readonly block: InstancedBufferGeometry; readonly card: InstancedBufferGeometry };
  readonly #line: InstancedBufferGeometry;
  readonly #materials: { readonly block: ShaderMaterial; readonly halo: ShaderMaterial; readonly line: ShaderMaterial };
  readonly #staff: InstancedBufferGeometry;
  /** Lanes whose colours a show gives; the others' go by the first player's. */
  readonly #colored = new Set<Color>();
  #chunks: DrawnChunk[] = [];
  #lanes = 1;

  /** @param stations cross-sections along a block, by how much its bend should show. */
  constructor(stations: number) {
    this.object.name = "blocks";
    // As many pieces as a block has: a ledger line bends with its note.
    this.#line = createLineGeometry(stations);
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
    const staves = Array.from({ length: MAX_LANES }, (_, lane) => STAFF_LINES.map((step) => ({ lane, step }))).flat();
    const columns = new Float32Array(staves.flatMap(({ step }) => [-FOREVER, FOREVER, step, step]));
    const lanes = new Float32Array(staves.map(({ lane }) => lane));
    this.#staff = withMarks(createLineGeometry(6 * stations), marks("line", columns, lanes));
    this.#staff.instanceCount = STAFF_LINES.length;
    this.object.add(this.#mesh(this.#staff, "line", ORDER.lines));
  }

  /** How many notes lie in each player's lane. */
  get laneNotes(): readonly number[] {
    const counts = Array.from({ length: this.#lanes }, () => 0);
    for (const { chunk } of this.#chunks) for (const lane of chunk.noteLanes) counts[lane] = (counts[lane] ?? 0) + 1;
    return counts;
  }

  /** The colours of the lanes' blocks as they were drawn last; read, never kept. */
  get laneColors(): readonly Color[] {
    return this.uniforms.colors.value.slice(0, this.#lanes);
  }

  /** A show gives these colours, which are among `uniforms`, itself. */
  setOwnColors(colors: readonly Color[]): void {
    this.#colored.clear();
    for (const color of colors) this.#colored.add(color);
  }

  /** Color the lanes whose colour no show gives, by the first player's. */
  colorLanes(): void {
    for (const { value: colors } of [this.uniforms.colors, this.uniforms.soundingColors]) {
      const [base] = colors;
      for (let lane = 1; lane < this.#lanes; lane++) {
        const color = colors[lane];
        if (base && color && !this.#colored.has(color)) companionColor(base, lane, color);
      }
    }
  }

  /**
   * Arrange the lanes.
   *
   * @param places of the players across the stage, metres; positive is the audience's right.
   * @param atKits whether each plays at a kit.
   */
  arrange(places: readonly number[], atKits: readonly boolean[] = []): void {
    const arrangement = arrangeLanes(places.slice(0, MAX_LANES), atKits);
    const { laneScale, heights, shifts, bends } = this.uniforms;
    bends.value.forEach((bend, lane) => {
      const { radius, turn } = atKits[lane] === true ? LANE.kit : LANE.bell;
      bend.set(radius, turn);
    });
    laneScale.value = arrangement.scale;
    arrangement.heights.forEach((height, lane) => (heights.value[lane] = height));
    arrangement.shifts.forEach((shift, lane) => (shifts.value[lane] = shift));
  }

  #mesh(geometry: InstancedBufferGeometry, material: "block" | "halo" | "line", order: number): Mesh {
    const mesh = new Mesh(geometry, this.#materials[material]);
    // Only the shader knows where the blocks are.
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    mesh.renderOrder = order;
    // Hairs that a floor's mirror image would not show.
    if (material === "line") mesh.layers.set(OUTLINE_LAYER);
    return mesh;
  }

  /** Lay the blocks out anew. */
  setScore(score: ScoreView): void {
    this.#clear();
    this.#lanes = Math.min(Math.max(score.players, 1), MAX_LANES);
    this.#staff.instanceCount = STAFF_LINES.length * this.#lanes;
    this.#chunks = layOut(score).map((chunk) => {
      const object = new Group();
      if (chunk.notes.length > 0) {
        const pieces = new InstancedBufferAttribute(chunk.notePieces, 1);
        const notes = { ...marks("note", chunk.notes, chunk.noteLanes), pieces };
        object.add(
          this.#mesh(withMarks(this.#shapes.block, notes), "block", ORDER.blocks),
          this.#mesh(withMarks(this.#shapes.card, notes), "halo", ORDER.halos),
        );
      }
      if (chunk.lines.length > 0) {
        const lines = marks("line", chunk.lines, chunk.lineLanes);
        object.add(this.#mesh(withMarks(this.#line, lines), "line", ORDER.lines));
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
    this.#staff.dispose();
  }
}
