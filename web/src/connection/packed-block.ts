import { HEADER_SIZE, type Manifest } from "../generated/protocol";

/** Frames of a block. */
export const BLOCK_FRAMES = 60;

/** 60 frames that never change. */
export interface Block {
  readonly number: number;
  /** Which state of score, cast and show it is of: 16 hexadecimal digits. */
  readonly revision: string;
  /** A bit for each frame that is a cut. */
  readonly cuts: Uint8Array;
  /** Of each frame its floats behind the header, at the manifest's offsets less 24 bytes. */
  readonly frames: readonly Float32Array[];
}

const MAGIC = 0x42_52;
const VERSION = 1;
const BLOCK_HEADER_SIZE = 32;
/** The fineness of a number whose bits are the float itself. */
const EXACT = 255;
/** What stands for the component that a quaternion goes without where it goes with all four. */
const WHOLE = 4;
const NEGATIVE = 8;

/** The revision that a packed block is of. */
export function revisionOf(bytes: ArrayBuffer): string {
  return headerOf(bytes).getBigUint64(8, true).toString(16).padStart(16, "0");
}

/** The number of the block that a frame is in. */
export function blockOf(frame: number): number {
  return Math.floor(frame / BLOCK_FRAMES);
}

/** Whether one of a block's frames, counted from 0, is a cut. */
export function isCut({ cuts }: Block, frame: number): boolean {
  return (((cuts[frame >> 3] ?? 0) >> (frame & 7)) & 1) === 1;
}

/**
 * Unpack a block, as docs/protocol.md lays it out.
 *
 * @throws RangeError when it is none, is damaged, or is one of another manifest or version
 */
export async function unpackBlock(manifest: Manifest, bytes: ArrayBuffer): Promise<Block> {
  const header = headerOf(bytes);
  const size = header.getUint32(24, true);
  if (size !== manifest.frame_size) {
    throw new RangeError(`a block of frames of ${size} bytes, and not of ${manifest.frame_size}`);
  }
  const body = await inflated(bytes.slice(BLOCK_HEADER_SIZE));
  return {
    number: header.getUint32(4, true),
    revision: revisionOf(bytes),
    cuts: new Uint8Array(bytes.slice(16, 24)),
    frames: framesOf(manifest, body),
  };
}

function headerOf(bytes: ArrayBuffer): DataView {
  const header = new DataView(bytes);
  if (bytes.byteLength < BLOCK_HEADER_SIZE || header.getUint16(0, true) !== MAGIC) {
    throw new RangeError(`${bytes.byteLength} bytes are no packed block`);
  }
  const version = header.getUint8(2);
  if (version !== VERSION) {
    throw new RangeError(`a packed block of version ${version}; this page reads version ${VERSION}`);
  }
  return header;
}

async function inflated(packed: ArrayBuffer): Promise<Uint8Array> {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  try {
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new RangeError("a packed block is damaged");
  }
}

/** Where each column of a block stands in a frame, in floats behind its header: joints, roots, parameters. */
function placesOf({ skeletons, parameters }: Manifest): { places: number[]; joints: number } {
  const places: number[] = [];
  const add = (offset: number, length: number): void => {
    for (let i = 0; i < length; i++) places.push((offset - HEADER_SIZE) / 4 + i);
  };
  for (const { offset, joints } of skeletons) add(offset, 4 * joints.length);
  const joints = places.length / 4;
  for (const { root_offset } of skeletons) add(root_offset, 3);
  for (const { offset, length } of parameters) add(offset, length);
  return { places, joints };
}

function framesOf(manifest: Manifest, body: Uint8Array): Float32Array[] {
  const { places, joints } = placesOf(manifest);
  const columns = places.length;
  const orders = joints + columns - 3 * joints;
  const first = orders + columns;
  const planes = first + 4 * columns + 1;
  const used = body[planes - 1] ?? 0;
  let moving = 0;
  for (let column = 0; column < columns; column++) if (body[orders + column] !== 0) moving += 1;
  const plane = moving * (BLOCK_FRAMES - 1);
  if (used > 4 || body.length !== planes + used * plane) {
    throw new RangeError("a packed block is not as long as its columns");
  }
  const length = (manifest.frame_size - HEADER_SIZE) / 4;
  const floats = new Float32Array(BLOCK_FRAMES * length);
  const bits = new Int32Array(floats.buffer);
  let next = planes;
  for (let column = 0; column < columns; column++) {
    const fineness = body[joints + (column < 4 * joints ? column >> 2 : column - 3 * joints)] ?? 0;
    const order = body[orders + column] ?? 0;
    const step = 2 ** (fineness / -4);
    let number = unzigzag(read(body, first + column, columns, 4));
    let difference = 0;
    let place = places[column] ?? 0;
    for (let frame = 0; frame < BLOCK_FRAMES; frame++, place += length) {
      if (frame > 0 && order !== 0) {
        const following = unzigzag(read(body, next++, plane, used));
        difference = order === 2 ? difference + following : following;
        number = (number + difference) | 0;
      }
      if (fineness === EXACT) bits[place] = number;
      else floats[place] = number * step;
    }
  }
  for (let joint = 0; joint < joints; joint++) {
    if (body[joint] === WHOLE && body[joints + joint] === EXACT) continue;
    const dropped = body[joint] ?? 0;
    for (let place = places[4 * joint] ?? 0; place < floats.length; place += length) complete(floats, place, dropped);
  }
  return Array.from({ length: BLOCK_FRAMES }, (_, frame) => floats.subarray(frame * length, (frame + 1) * length));
}

/** Give a quaternion the component that it went without, or make it one of unit length. */
function complete(floats: Float32Array, place: number, dropped: number): void {
  let squares = 0;
  for (let i = place; i < place + 4; i++) squares += (floats[i] ?? 0) ** 2;
  if (dropped === WHOLE) {
    const length = Math.sqrt(Math.max(squares, 1e-12));
    for (let i = place; i < place + 4; i++) floats[i] = (floats[i] ?? 0) / length;
  } else {
    const greatest = Math.sqrt(Math.max(1 - squares, 0));
    floats[place + (dropped % NEGATIVE)] = dropped >= NEGATIVE ? -greatest : greatest;
  }
}

/** A number whose bytes stand in planes, the lowest first. */
function read(body: Uint8Array, at: number, plane: number, planes: number): number {
  let number = 0;
  for (let i = 0; i < planes; i++) number |= (body[at + i * plane] ?? 0) << (8 * i);
  return number;
}

/** 0, 1, 2, 3 … are 0, -1, 1, -2 …. */
function unzigzag(number: number): number {
  return (number >>> 1) ^ -(number & 1);
}
