"""The manifest: what every frame of a session holds, and where."""

from typing import Annotated, Literal

from pydantic import Field

from reina.curves.value_types import TypeName
from reina.protocol.model import WireModel

PROTOCOL_VERSION = 1
SUBPROTOCOL: Literal["reina.v1"] = "reina.v1"


class SkeletonManifest(WireModel):
    """One skeleton of the frame."""

    name: str
    """`player` or the instrument's name; another player's begin with `players/2/`."""
    player: int
    """Whose it is: a place in the cast, 0 being the first."""
    rig: str
    """The rig's name: its joints' rest pose and models stand at the link `rigs[rig]`."""
    joints: list[str]
    """Joint names, parents before children; the first is the root."""
    offset: int
    """Bytes from the frame's start to its joint quaternions, x y z w as float32, in the order of `joints`."""
    root_offset: int
    """Bytes from the frame's start to its root's position, x y z as float32, metres."""


class ParameterManifest(WireModel):
    """One parameter of the frame."""

    path: str
    type: TypeName
    offset: int
    """Bytes from the frame's start to its value."""
    length: Annotated[int, Field(ge=1)]
    """How many float32 the value has."""
    blend: bool
    """False: a page never blends it between two frames."""


class Manifest(WireModel):
    """Where everything in a frame is; all of it in bytes, all of it little-endian."""

    protocol: Literal["reina.v1"] = SUBPROTOCOL
    fps: int
    """Frames a second of song time: frame k shows song time k / fps."""
    frame_size: int
    """Bytes of one frame, a multiple of 8."""
    skeletons: list[SkeletonManifest]
    parameters: list[ParameterManifest]
