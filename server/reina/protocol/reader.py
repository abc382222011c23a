"""The page's frame reader, written from the declaration of the frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.protocol.frame import HEADER, FrameFlag, fields_of
from reina.protocol.manifest import PROTOCOL_VERSION, SUBPROTOCOL

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

_GETTERS: dict[str, str] = {
    "|u1": "getUint8({offset})",
    "<u2": "getUint16({offset}, true)",
    "<u4": "getUint32({offset}, true)",
    "<f8": "getFloat64({offset}, true)",
}
_HEADER_DOCUMENTATION = {
    "version": "Protocol version.",
    "epoch": "The clock's epoch, modulo 256; frames of an older one are not shown.",
    "flags": "FLAG_PLAYING, FLAG_FIRST, FLAG_CUT.",
    "index": "k: song time is k / fps.",
    "song_time_s": "Song time, seconds.",
    "due_time_s": "Server time at which it is to be seen, on the clock of pong; 0 over HTTP.",
}


def _camel(name: str) -> str:
    """`song_time_s` -> `songTimeS`, as TypeScript writes names."""
    head, *rest = name.split("_")
    return head + "".join(word.capitalize() for word in rest)


def _getter(name: str, dtype: DTypeLike, offset: int) -> str:
    call = _GETTERS[np.dtype(dtype).str].format(offset=offset)
    return (
        f"  /** {_HEADER_DOCUMENTATION[name]} */\n"
        f"  get {_camel(name)}(): number {{\n    return this.header.{call}\n  }}"
    )


def constants() -> str:
    """What is said of every stream and every frame, as TypeScript."""
    return f"""export const PROTOCOL_VERSION = {PROTOCOL_VERSION}
export const SUBPROTOCOL = "{SUBPROTOCOL}"
export const HEADER_SIZE = {HEADER.itemsize}
"""


def frame_reader() -> str:
    """The flags and the classes `Frame` and `FrameReader`, as TypeScript."""
    flags = "\n".join(f"export const FLAG_{flag.name} = {flag.value}" for flag in FrameFlag)
    getters = "\n\n".join(_getter(name, dtype, offset) for name, dtype, offset in fields_of(HEADER))
    predicates = "\n\n".join(
        f"  get {str(flag.name).lower()}(): boolean {{\n"
        f"    return (this.flags & FLAG_{flag.name}) !== 0\n  }}"
        for flag in FrameFlag
    )
    return f"""import {{ HEADER_SIZE, PROTOCOL_VERSION, type Manifest }} from "./protocol"

{flags}

{_FRAME.replace("%GETTERS%", getters).replace("%PREDICATES%", predicates)}
{_READER}"""


_FRAME = """\
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

%GETTERS%

%PREDICATES%
}
"""

_READER = """\
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
"""
