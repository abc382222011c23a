import { HEADER_SIZE, type Manifest, type ParameterManifest } from "../generated/protocol";

const FLOAT_BYTES = 4;

type Kind = "quaternions" | "numbers" | "held";

/** A run of floats of a frame (counted from the header's end) that is blended in one way. */
interface Span {
  readonly kind: Kind;
  readonly start: number;
  end: number;
}

/** What a parameter's floats are, in their order, where it is blended; a type that is not here is all numbers. */
const PIECES: Partial<Record<ParameterManifest["type"], readonly (readonly [kind: Kind, length: number])[]>> = {
  orientation: [["quaternions", 4]],
  transform: [
    ["numbers", 3],
    ["quaternions", 4],
    ["numbers", 3],
  ],
};

/**
 * Blends two neighbouring frames for displays whose refresh falls between them.
 *
 * Quaternions take the shorter way by normalised linear interpolation (two frames lie so close that it cannot be told
 * from slerp), roots and numbers go straight, what the manifest does not want blended stays as in the earlier frame.
 */
export class FrameBlend {
  /** Floats of one frame without its header. */
  readonly length: number;
  readonly #spans: Span[] = [];

  constructor(manifest: Manifest) {
    this.length = (manifest.frame_size - HEADER_SIZE) / FLOAT_BYTES;
    for (const skeleton of manifest.skeletons) this.#add("quaternions", skeleton.offset, 4 * skeleton.joints.length);
    for (const skeleton of manifest.skeletons) this.#add("numbers", skeleton.root_offset, 3);
    for (const { type, blend, offset, length } of manifest.parameters) {
      const pieces = blend ? (PIECES[type] ?? [["numbers", length]]) : [["held", length] as const];
      let at = offset;
      for (const [kind, floats] of pieces) {
        this.#add(kind, at, floats);
        at += floats * FLOAT_BYTES;
      }
    }
  }

  /**
   * Write the blend of two frames into `out`, all three as floats behind the header.
   *
   * @param u how far from `a` to `b`, 0…1; 0 and 1 copy a frame bit for bit
   */
  blend(a: Float32Array, b: Float32Array, u: number, out: Float32Array): void {
    if (u <= 0) out.set(a);
    else if (u >= 1) out.set(b);
    else {
      for (const span of this.#spans) {
        if (span.kind === "quaternions") blendQuaternions(a, b, span, u, out);
        else if (span.kind === "numbers") blendNumbers(a, b, span, u, out);
        else for (let i = span.start; i < span.end; i++) out[i] = a[i] ?? 0;
      }
    }
  }

  #add(kind: Kind, offset: number, length: number): void {
    const start = (offset - HEADER_SIZE) / FLOAT_BYTES;
    const last = this.#spans.at(-1);
    if (last?.kind === kind && last.end === start) last.end += length;
    else this.#spans.push({ kind, start, end: start + length });
  }
}

function blendNumbers(a: Float32Array, b: Float32Array, span: Span, u: number, out: Float32Array): void {
  for (let i = span.start; i < span.end; i++) {
    const from = a[i] ?? 0;
    out[i] = from + ((b[i] ?? 0) - from) * u;
  }
}

function blendQuaternions(a: Float32Array, b: Float32Array, span: Span, u: number, out: Float32Array): void {
  for (let i = span.start; i < span.end; i += 4) {
    let dot = 0;
    for (let k = i; k < i + 4; k++) dot += (a[k] ?? 0) * (b[k] ?? 0);
    const v = dot < 0 ? -u : u;
    let squares = 0;
    for (let k = i; k < i + 4; k++) {
      const value = (a[k] ?? 0) * (1 - u) + (b[k] ?? 0) * v;
      out[k] = value;
      squares += value * value;
    }
    const scale = squares > 0 ? 1 / Math.sqrt(squares) : 1;
    for (let k = i; k < i + 4; k++) out[k] = (out[k] ?? 0) * scale;
  }
}
