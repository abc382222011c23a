"""Control messages: the text half of the stream, told apart by `type`."""

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from reina.protocol.alignment import AlignmentState
from reina.protocol.manifest import Manifest
from reina.protocol.model import RequestModel, WireModel
from reina.protocol.notes import WireNote
from reina.protocol.transport import TransportState


class SongSegments(WireModel):
    """A rendered song in segments of one length, each of which can be had as soon as it is rendered."""

    href: str
    """A segment stands at `{href}/{number}`, from 0 on, and never changes."""
    media_type: str
    count: int
    segment_s: float
    """Segment n begins at n times this song time; the last is shorter."""
    overlap_s: float
    """How much each holds beside: of the sound before it, and again of the sound after it."""
    song_s: float
    """How long the whole lasts."""


class SongState(WireModel):
    """The sound that goes with the score."""

    href: str
    """Another one whenever the sound is another: what was fetched from it before may be kept."""
    status: Literal["ready", "rendering", "failed"]
    """`rendering`: the server is still making it from the score; `song_ready` follows."""
    source: Literal["uploaded", "rendered"]
    media_type: str
    progress: float
    """0 to 1; 1 once it is ready."""
    segments: SongSegments | None
    """Null for an uploaded song, and until a rendered one is planned."""


class StreamLinks(WireModel):
    """Where a viewer finds what the stream does not carry."""

    session: str
    score: str
    show: str
    song: str
    rigs: dict[str, str]
    """Rig name to its description."""


class FrameBlocks(WireModel):
    """The frames, packed: 60 to a block, which never changes."""

    revision: str
    """Which state of score, cast and show they are of: 16 hexadecimal digits; a block's header has it."""
    href: str
    """Block n stands at `{href}/{n}`, for any cache to keep; at another origin where there is one for it."""
    pushed: bool
    """Whether those who ask the stream for packed blocks get them; else they fetch them ahead of time."""


class Hello(Manifest):
    """First on every stream: whoever joins late or again needs nothing else."""

    type: Literal["hello"] = "hello"
    session: str
    title: str
    duration_s: float
    """Song time at which the clock stops: the player has settled, and the song is over."""
    links: StreamLinks
    blocks: FrameBlocks
    song: SongState
    alignment: AlignmentState
    transport: TransportState


class Transport(TransportState):
    """The music clock changed: played, paused, sought, another rate or loop, or an edit raised the epoch."""

    type: Literal["transport"] = "transport"


class ShowState(WireModel):
    """Which state of its show a session is in."""

    revision: int
    """Rises by one with each edit, undo and redo; counted anew when the server loads the session."""
    etag: str
    """The show's validator, quotes and all: what `If-Match` takes."""
    undo: int
    """How many steps can be taken back."""
    redo: int
    """How many of those taken back can be done again."""


class ShowChanged(ShowState):
    """The show was edited; the frames already follow."""

    type: Literal["show_changed"] = "show_changed"
    path: str | None
    """The parameter whose track changed, or null for several or the whole show."""
    paths: list[str] | None
    """The parameters whose tracks changed or are gone, or null when more than tracks changed."""


class ScoreChanged(WireModel):
    """What is played was chosen anew; read the score again, and the song if its `href` changed."""

    type: Literal["score_changed"] = "score_changed"
    sequence: int
    """Which of the file's sequences is played, counted from 0."""
    part: int
    transposition: int
    written: bool
    """Whether the part is taken as notated for the instrument."""
    octave_fit: bool
    """Whether the part is moved into range by octaves."""
    joined_parts: list[int]
    """Further parts that the player plays together with it, ascending."""
    handedness: str
    """Which of the player's hands leads."""
    usual_fingerings: bool
    """Whether no fingering is taken but the usual one of each note."""
    duration_s: float
    """How long the music now lasts."""
    song: SongState


class BlocksChanged(FrameBlocks):
    """Score, cast or show changed: the frames are of another revision from here on.

    `transport` follows; so does `hello` before it, where frames hold something else.
    """

    type: Literal["blocks_changed"] = "blocks_changed"


class SongReady(WireModel):
    """The song can be fetched."""

    type: Literal["song_ready"] = "song_ready"
    song: SongState


class AlignmentChanged(AlignmentState):
    """The search for the score in the song went on or came to an end, or somebody put something right.

    Where it moves the music `score_changed` comes too.
    """

    type: Literal["alignment_changed"] = "alignment_changed"


class NoteOn(WireNote):
    """A note of the played part begins (or sounds already, after a seek into it)."""

    type: Literal["note_on"] = "note_on"
    song_time_s: float
    """When, in song time."""


class NoteOff(WireNote):
    """A note of the played part ends (or is cut off by a pause or a seek)."""

    type: Literal["note_off"] = "note_off"
    song_time_s: float
    """When, in song time."""


class Pong(WireModel):
    """The answer to `ping`."""

    type: Literal["pong"] = "pong"
    id: int
    server_time_s: float


class StreamError(WireModel):
    """Something a viewer sent could not be used, or something of the session failed."""

    type: Literal["error"] = "error"
    title: str
    detail: str


class Ping(RequestModel):
    """A viewer measures the offset between its clock and the server's."""

    type: Literal["ping"]
    id: Annotated[int, Field(ge=0, le=2**53)]


class Lead(RequestModel):
    """A viewer wants frames longer before they are due, as behind a network that is slow or loses packets.

    Some that were sent already may come again.
    """

    type: Literal["lead"]
    lead_s: Annotated[float, Field(ge=0.1, le=1.5)]
    """How long before they are due frames are sent from now on; 0.1 until it is said."""


ServerMessage = Annotated[
    Hello
    | Transport
    | ShowChanged
    | ScoreChanged
    | BlocksChanged
    | SongReady
    | AlignmentChanged
    | NoteOn
    | NoteOff
    | Pong
    | StreamError,
    Field(discriminator="type"),
]
ViewerMessage = Annotated[Ping | Lead, Field(discriminator="type")]

server_message: TypeAdapter[ServerMessage] = TypeAdapter(ServerMessage)
viewer_message: TypeAdapter[ViewerMessage] = TypeAdapter(ViewerMessage)
