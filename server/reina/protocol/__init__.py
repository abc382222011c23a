"""The wire: control messages, HTTP bodies, the binary frame, and the TypeScript generated from them."""

from reina.protocol.frame import (
    HEADER,
    FrameError,
    FrameFlag,
    Frames,
    build_manifest,
    bytes_of,
    decode,
    encode_block,
    frame_dtype,
    join,
    stamp,
)
from reina.protocol.manifest import (
    PROTOCOL_VERSION,
    SUBPROTOCOL,
    Manifest,
    ParameterManifest,
    SkeletonManifest,
)
from reina.protocol.packed_block import Steps, pack, unpack

__all__ = [
    "HEADER",
    "PROTOCOL_VERSION",
    "SUBPROTOCOL",
    "FrameError",
    "FrameFlag",
    "Frames",
    "Manifest",
    "ParameterManifest",
    "SkeletonManifest",
    "Steps",
    "build_manifest",
    "bytes_of",
    "decode",
    "encode_block",
    "frame_dtype",
    "join",
    "pack",
    "stamp",
    "unpack",
]
