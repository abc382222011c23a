"""docs/protocol.md: the stream, described from its declarations."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, get_args

from reina.protocol import messages, notes, transport
from reina.protocol.alignment import AlignmentState
from reina.protocol.frame import ALIGNMENT, HEADER, FrameFlag, fields_of
from reina.protocol.manifest import (
    PROTOCOL_VERSION,
    SUBPROTOCOL,
    Manifest,
    ParameterManifest,
    SkeletonManifest,
)
from reina.protocol.packed_block import EXACT, MAGIC, NEGATIVE, PACKED_VERSION, QUARTERS, WHOLE
from reina.protocol.packed_block import HEADER as PACKED_HEADER
from reina.protocol.typescript import field_types

if TYPE_CHECKING:
    from pydantic import BaseModel

FROM_SERVER: tuple[type[BaseModel], ...] = get_args(get_args(messages.ServerMessage)[0])
FROM_VIEWER: tuple[type[BaseModel], ...] = get_args(get_args(messages.ViewerMessage)[0])
PARTS: tuple[type[BaseModel], ...] = (
    SkeletonManifest,
    ParameterManifest,
    messages.StreamLinks,
    messages.FrameBlocks,
    messages.SongState,
    AlignmentState,
    transport.TransportState,
    transport.Loop,
    notes.WireNote,
)

_INTRODUCTION = f"""\
<!-- Written by `make generate` from server/reina/protocol; do not edit. -->
# The stream, version {PROTOCOL_VERSION}

`WS /api/v1/sessions/{{id}}/stream`, subprotocol `{SUBPROTOCOL}`; another version is refused before
the handshake ends. Text messages are JSON control messages, told apart by `type`; the first is
`hello`, and whoever joins late or again needs nothing else. It is said again when another player comes
on stage. Whoever read score and cast before it reads them again where its epoch is not the one that
`GET .../transport` said before they were read. Binary messages are frames, or
packed blocks of them. No message is compressed by the WebSocket. `?notes=0` leaves `note_on` and
`note_off` out, which are half of what a viewer of packed blocks is sent: the score has them all.

## Frames

A binary message is one or more whole frames, back to back; `?frames_per_message=` (1 to 12, default
1) asks for how many. A frame is little-endian, `hello.frame_size` bytes long, each section is
padded with zeros to {ALIGNMENT} bytes. J counts the joints of all skeletons, S the skeletons, P the
floats of all parameters; `hello` says where each skeleton and each parameter stands.

Frames lie on the grid k / fps whatever the rate of play (above rate 1 some are passed over), are
sent about 100 ms before they are due (longer, where the viewer asks for it by `lead`), and are of
the clock's present epoch: a viewer discards frames of an older one. While paused, one frame comes
with each change. A viewer shows the frame whose due time has come; where it blends two neighbouring
frames, it does not blend into one that is flagged as a cut, nor parameters whose `blend` is false.

The same frames come over HTTP from `GET /api/v1/sessions/{{id}}/frames?start_s=&end_s=&fps=`, with
epoch and due time 0; what `hello` says comes from `GET .../manifest`.

| byte | type | field |
| --- | --- | --- |

"""

_TYPES = {"|u1": "u8", "<u2": "u16", "<u4": "u32", "<u8": "u64", "<f8": "f64", "|S2": "bytes"}
_PACKED_FIELDS = {
    "magic": f"`{MAGIC.decode()}`",
    "version": f"{PACKED_VERSION}",
    "fps": "frames a second",
    "block": "its number b",
    "revision": "`blocks.revision`, as a number",
    "cuts": "bit n: frame n of the block is a cut",
    "frame_size": "`hello.frame_size` of the frames",
    "unused": "0",
}

_SECTIONS = f"""\
| {HEADER.itemsize} | f32 × 4 × J | `rotations`: local joint quaternions x y z w, rest included |
| ... | f32 × 3 × S | `root_positions`: metres, in place of the root joint's rest translation |
| ... | f32 × P | `parameters`: booleans 0 or 1, choices by index, colours linear sRGB |

Flags:

"""

_PACKED = f"""
## Packed blocks

Frames 60·b … 60·b + 59 are block b: a pure function of score, cast and show, all of which `blocks.revision`
stands for. `?packed=1` has blocks sent in place of frames, the present one first, each about two seconds
before its first frame is due; the viewer works out from `transport` which frame is due when. What a loop
comes back to is not sent again. Any block can be had from `{{blocks.href}}/{{b}}` too, for any cache to keep,
and where the revision is another meanwhile that answers 410 and the present one; where `blocks.pushed` is
false all of them are to be had there alone. `?packed=lossless` and `?form=lossless` give them bit for bit, at
four to five times the length.

Little-endian. The header:

| byte | type | field |
| --- | --- | --- |
%PACKED_FIELDS%

The rest is compressed by zlib (RFC 1950). Decompressed, for J joints, S skeletons and P floats of parameters,
in this order; a column is one float of the frames, of C = 4·J + 3·S + P:

| bytes | |
| --- | --- |
| J | of each joint the component of its quaternion (0 … 3) that is left out, and {NEGATIVE} more where it \
is negative: its column is 0, and it is ±√(1 − x² − …) of the others; {WHOLE} where none is, and all four \
are normalised, unless they are exact |
| J + 3·S + P | the fineness of each joint (for its four columns), of each float of the roots' positions, of \
each float of the parameters: a whole number n stands for n·2^(−fineness/{QUARTERS}), or, where it is \
{EXACT}, n's 32 bits are the float itself |
| C | the order of each column: 0, it does not move; 1, its differences follow; 2, the differences of these |
| 4·C | each column's first number: the lowest bytes of all, then the next, to the highest |
| 1 | how many planes follow |
| planes·59·M | of each of the M columns that move its 59 differences: the lowest bytes of all, then the \
next |

Whole numbers have 32 bits, differences are modulo 2^32, and both are written zigzag: 0, −1, 1, −2 … are
0, 1, 2, 3 …. The first difference of the second order is that of the first.
"""

_EXAMPLE = """
## Reading frames in Python

```python
from reina.protocol import Manifest, decode

frames = decode(manifest, message)  # manifest: the fields of `hello` that Manifest names
frames["song_time_s"]  # (F,)
frames["rotations"]  # (F, J, 4)
```

`unpack(manifest, message)` does the same for a packed block.

## Messages from the server
"""


def documentation() -> str:
    """The whole document."""
    lines = [_INTRODUCTION.rstrip("\n")]
    lines.extend(
        f"| {offset} | {_TYPES[dtype.str]} | `{name}` |" for name, dtype, offset in fields_of(HEADER)
    )
    lines.append(_SECTIONS.rstrip("\n"))
    lines.append("")
    lines.extend(f"- bit {flag.value.bit_length() - 1}: {str(flag.name).lower()}" for flag in FrameFlag)
    packed = "\n".join(
        f"| {offset} | {_TYPES[dtype.str]} | {_PACKED_FIELDS[name]} |"
        for name, dtype, offset in fields_of(PACKED_HEADER)
    )
    lines.append(_PACKED.rstrip("\n").replace("%PACKED_FIELDS%", packed))
    lines.append(_EXAMPLE)
    lines.extend(_model(model) for model in FROM_SERVER)
    lines.append("## Messages from the viewer\n")
    lines.extend(_model(model) for model in FROM_VIEWER)
    lines.append("## What they are made of\n")
    lines.extend(_model(model) for model in (Manifest, *PARTS))
    return "\n".join(lines).rstrip("\n") + "\n"


def _model(model: type[BaseModel]) -> str:
    kind = model.model_fields.get("type")
    values = get_args(kind.annotation) if kind else ()
    title = f"`{values[0]}`" if len(values) == 1 else model.__name__
    rows = [
        f"### {title}",
        "",
        inspect.cleandoc(model.__doc__ or ""),
        "",
        "| field | type | |",
        "| --- | --- | --- |",
    ]
    for name, (kind_of, description) in field_types(model).items():
        shown = kind_of.replace("|", "\\|")
        rows.append(f"| `{name}` | `{shown}` | {description} |")
    return "\n".join([*rows, ""])
