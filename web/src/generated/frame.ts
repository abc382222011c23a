// Written by `make generate` from server/reina/protocol; do not edit. Field names are the wire's.

import { HEADER_SIZE, PROTOCOL_VERSION, type Manifest } from "./protocol"

export const FLAG_PLAYING = 1
export const FLAG_FIRST = 2
export const FLAG_CUT = 4

/**
 * Storage for one frame, with views into it that are made once: reading a frame into it allocates nothing.
 * The views are in the platform's byte order, which is the wire's (little-endian) wherever browsers run.
 */
export class Frame {
  /** The whole frame as 32-bit words. */
  readonly words: Uint32Array
  /** Joint quaternions of each skeleton, x y z w, in the order of its joints. */
  readonly rotations: readonly Float32Array[]
  /** Root position of each skeleton, x y z, metres, in place of the root joint's rest translation. */
  readonly rootPositions: readonly Float32Array[]
  /** The value of each parameter, in the manifest's order. */
  readonly parameters: readonly Float32Array[]
  private readonly header: DataView

  constructor(manifest: Manifest) {
    const buffer = new ArrayBuffer(manifest.frame_size)
    this.words = new Uint32Array(buffer)
    this.header = new DataView(buffer, 0, HEADER_SIZE)
    this.rotations = manifest.skeletons.map(
      (skeleton) => new Float32Array(buffer, skeleton.offset, 4 * skeleton.joints.length),
    )
    this.rootPositions = manifest.skeletons.map(
      (skeleton) => new Float32Array(buffer, skeleton.root_offset, 3),
    )
    this.parameters = manifest.parameters.map(
      (parameter) => new Float32Array(buffer, parameter.offset, parameter.length),
    )
  }

  /** Protocol version. */
  get version(): number {
    return this.header.getUint8(0)
  }

  /** The clock's epoch, modulo 256; frames of an older one are not shown. */
  get epoch(): number {
    return this.header.getUint8(1)
  }

  /** FLAG_PLAYING, FLAG_FIRST, FLAG_CUT. */
  get flags(): number {
    return this.header.getUint16(2, true)
  }

  /** k: song time is k / fps. */
  get index(): number {
    return this.header.getUint32(4, true)
  }

  /** Song time, seconds. */
  get songTimeS(): number {
    return this.header.getFloat64(8, true)
  }

  /** Server time at which it is to be seen, on the clock of pong; 0 over HTTP. */
  get dueTimeS(): number {
    return this.header.getFloat64(16, true)
  }

  get playing(): boolean {
    return (this.flags & FLAG_PLAYING) !== 0
  }

  get first(): boolean {
    return (this.flags & FLAG_FIRST) !== 0
  }

  get cut(): boolean {
    return (this.flags & FLAG_CUT) !== 0
  }
}

/**
 * Reads binary messages: one or more whole frames, back to back. Open one, then read its frames in turn:
 *
 *     const count = reader.open(event.data)
 *     for (let number = 0; number < count; number++) reader.read(number, queue.next())
 */
export class FrameReader {
  readonly manifest: Manifest
  private readonly parameterIndices: ReadonlyMap<string, number>
  private message = new Uint32Array(0)

  constructor(manifest: Manifest) {
    this.manifest = manifest
    this.parameterIndices = new Map(manifest.parameters.map((parameter, index) => [parameter.path, index]))
  }

  /** A frame to read into; make as many as the queue is long, once. */
  createFrame(): Frame {
    return new Frame(this.manifest)
  }

  /** Where in Frame.parameters a path stands, or -1. */
  parameterIndex(path: string): number {
    return this.parameterIndices.get(path) ?? -1
  }

  /** How many frames a message holds; throws a RangeError when they are not whole ones of this version. */
  open(message: ArrayBuffer): number {
    const size = this.manifest.frame_size
    if (message.byteLength === 0 || message.byteLength % size !== 0) {
      throw new RangeError(`${message.byteLength} bytes are not whole frames of ${size} bytes`)
    }
    this.message = new Uint32Array(message)
    const version = (this.message[0] ?? 0) & 0xff
    if (version !== PROTOCOL_VERSION) {
      throw new RangeError(`a frame of version ${version}; this page reads version ${PROTOCOL_VERSION}`)
    }
    return message.byteLength / size
  }

  /** Copy a frame of the opened message, counted from 0, into storage of its own; allocates nothing. */
  read(number: number, into: Frame): void {
    const { message } = this
    const { words } = into
    const start = number * words.length
    for (let i = 0; i < words.length; i++) {
      words[i] = message[start + i] ?? 0
    }
  }
}
