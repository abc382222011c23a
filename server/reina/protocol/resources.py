"""The bodies of the HTTP interface."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, Json, WithJsonSchema

from reina.curves.value_types import TypeName
from reina.instruments import MAX_PLAYERS
from reina.instruments.note_fingerings import Side
from reina.protocol.alignment import AlignmentState
from reina.protocol.messages import ShowState, SongState
from reina.protocol.model import RequestModel, WireModel
from reina.protocol.notes import WireNote
from reina.show.document import ShowHead, ShowKeyframe, ShowTrack

Title = Annotated[str, Field(min_length=1, max_length=200)]
PlayerName = Annotated[str, Field(min_length=1, max_length=200)]
PartIndex = Annotated[int, Field(ge=0)]
Handedness = Side


def _split_at_commas(text: str) -> list[str]:
    """``"1, 2"`` -> ``["1", "2"]``; nothing is no part."""
    return [piece.strip() for piece in text.split(",")] if text.strip() else []


class Fault(WireModel):
    """One of several things that were wrong."""

    detail: str
    location: str | None
    """The place in the input."""


class Problem(WireModel):
    """Problem details (RFC 9457), sent as application/problem+json."""

    type: str
    title: str
    status: int
    detail: str
    errors: list[Fault] = Field(default_factory=list[Fault])
    """Each fault, where there are several; else empty."""
    instance: str | None = None
    """`urn:reina:request:` and the id of the request, which the server's log has too."""


class Warned(WireModel):
    """Something in a file that could not be taken as it stands, and what was done instead."""

    kind: str
    place: str
    message: str


class Finding(WireModel):
    """What a musician is told of one kind of warning, or of who plays what, counted."""

    kind: str
    """A stable name; with `count` and `values` all that another language's words need."""
    about: Literal["choice", "playing", "file", "song", "show"]
    """Who plays what; what became of a part; the score's file; the recording; the show."""
    weight: Literal["cut", "repaired", "note"]
    """Music is missing; something was set right; good to know."""
    count: int
    """How many things it is about."""
    values: dict[str, str | int]
    """What the words hold beside the count."""
    text: str
    """The words, in English, without a full stop."""
    player: int | None
    """The place in the cast of the player whom it concerns; null for nobody."""
    details: list[Warned]
    """The warnings, one by one; of very many the first."""


class PartSummary(WireModel):
    """One part of a score."""

    index: int
    name: str
    program: int | None
    """General MIDI program, 0 to 127, where the file says one."""
    is_drums: bool
    notes: int
    """How many notes it has."""


class PartChoice(WireModel):
    """How well a part suits the player's instrument."""

    part: int
    score: float
    reasons: list[str]


class SessionLinks(WireModel):
    """Everything of a session, and the page that shows it."""

    self: str
    page: str
    score: str
    song: str
    show: str
    transport: str
    frames: str
    manifest: str
    stream: str


class Stance(WireModel):
    """A pose of a motion file that a session's players can stand in."""

    name: str
    """What the show's `player/stance` chooses it by."""
    file: str | None
    """What its sender called the motion file."""
    time_s: float
    """Of which of its frames the pose is."""
    href: str
    """Where it is taken away."""


class Session(WireModel):
    """One session: a score, its player, its show and its clock."""

    id: str
    title: str
    public: bool
    """Whether the list of sessions shows it; otherwise only who has the id can watch."""
    created_at: str
    """ISO 8601, UTC."""
    duration_s: float
    instrument: str
    part: int
    """The part that the player plays."""
    transposition: int
    """Semitones by which the player's part was asked to be moved."""
    written: bool
    """Whether the part is taken as notated for the instrument: a B♭ trumpet then sounds a tone lower."""
    octave_fit: bool
    """Whether the part is moved by the octaves that bring most of its notes into range."""
    joined_parts: list[int]
    """Further parts that the player plays together with it, as if their notes were its own; ascending."""
    handedness: str
    """Which of the player's hands leads."""
    usual_fingerings: bool
    """Whether no fingering is taken but the usual one of each note."""
    player: str
    """Who plays: a rig with a hold on the instrument."""
    players: list[str]
    """Who could."""
    sounding_transposition: int
    """Semitones by which the part is played away from the file's pitches: all three together."""
    sequence: int
    """Which of the file's sequences is played, counted from 0."""
    sequences: int
    """How many the file holds: several only in MIDI files of format 2."""
    parts: list[PartSummary]
    choices: list[PartChoice]
    """The parts that the instrument could play, best first."""
    cast: "CastSummary"
    """Everybody who plays: part, instrument, player and the like beside it are the first one's."""
    notes: int
    warnings: list[Warned]
    findings: list[Finding]
    """The warnings as a musician is told of them, after who plays what and why."""
    song: SongState
    alignment: AlignmentState
    stances: list[Stance]
    """Its own, in the order of the choices of `player/stance`."""
    ends_at: str | None = None
    """When it will be ended unless somebody sees it before, ISO 8601, UTC; null unless that is near."""
    links: SessionLinks
    mine: bool = False
    """Whether who asks is signed in as the person who made it, and controls it without its token."""


class CreatedSession(Session):
    """A session as its creator sees it, once."""

    control_token: str
    """What changes the session needs: `Authorization: Bearer <control_token>`."""


class ControlToken(WireModel):
    """A session's control token, as it is told once."""

    control_token: str


class SignIn(WireModel):
    """Who asks, and whether the server wants to know."""

    needed: bool
    """Whether only who is signed in may upload."""
    asks: Literal["password", "name-and-password", "proxy"] | None
    """By what one signs in; null where nobody does. `proxy`: at the proxy before the server, not here."""
    signed_in: bool
    name: str | None
    """Who it is; null where that is not known, as where all have one password."""
    by: Literal["password", "proxy"] | None


class Password(RequestModel):
    """What somebody signs in by."""

    name: Annotated[str, Field(min_length=1, max_length=200)] | None = None
    """Whose password it is; where all have one it is left out."""
    password: Annotated[str, Field(min_length=1, max_length=200)]


class SessionSummary(WireModel):
    """A session in the list."""

    id: str
    title: str
    created_at: str
    links: SessionLinks


class SessionList(WireModel):
    """Public sessions, newest first."""

    sessions: list[SessionSummary]
    next: str | None
    """What the next page is asked for with, as `after`; null when there are no more."""


class SessionChange(RequestModel):
    """What PATCH may change of a session; a field left out stays.

    Of another sequence the best part is played, unless one is named with it. Another part is played alone,
    unless others are named with it.
    """

    title: Title | None = None
    public: bool | None = None
    part: PartIndex | None = None
    transposition: Annotated[int, Field(ge=-48, le=48)] | None = None
    written: bool | None = None
    octave_fit: bool | None = None
    joined_parts: list[PartIndex] | None = None
    usual_fingerings: bool | None = None
    sequence: Annotated[int, Field(ge=0)] | None = None
    player: PlayerName | None = None
    handedness: Handedness | None = None
    cast: Literal["auto"] | None = None
    """`auto`: the score itself says who plays it; the fields for one player are then left out."""


class CastingFields(RequestModel):
    """What a player is asked to do; a field left out is as it is by default."""

    part: PartIndex | None = None
    """Index of the part; null: the one that suits the instrument best of those that nobody else plays."""
    instrument: PlayerName = "trumpet"
    player: PlayerName = "trumpeter"
    """Who plays: a rig with a hold on the instrument."""
    seat: PlayerName | None = None
    """Where on the stage; null: by how many play."""
    transposition: Annotated[int, Field(ge=-48, le=48)] = 0
    written: bool = False
    octave_fit: bool = False
    joined_parts: list[PartIndex] = Field(default_factory=list[int])
    handedness: Handedness = "right"
    """Which hand leads, where the instrument can be played so."""
    usual_fingerings: bool = False
    """Take no fingering but the usual one of each note."""


class CastFields(RequestModel):
    """Who is to play what, the first player first."""

    castings: Annotated[list[CastingFields], Field(min_length=1, max_length=MAX_PLAYERS)]
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Which sequence of a MIDI file of format 2; null leaves it as it is."""


class AutoCast(RequestModel):
    """That the score itself is to say who plays it."""

    cast: Literal["auto"]
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Which sequence of a MIDI file of format 2; null leaves it as it is."""


class SessionFields(WireModel):
    """What the form of POST /sessions may say beside its files."""

    title: Title | None = None
    public: bool = False
    part: PartIndex | None = None
    transposition: Annotated[int, Field(ge=-48, le=48)] = 0
    """Semitones to move the part by."""
    written: bool = False
    """The part is notated for the B♭ trumpet: it sounds a tone lower than its pitches say."""
    octave_fit: bool = False
    """Move the part by the octaves that bring most of it into range."""
    joined_parts: Annotated[
        list[PartIndex],
        BeforeValidator(_split_at_commas),
        WithJsonSchema({"type": "string", "pattern": r"^\s*(\d+\s*(,\s*\d+\s*)*)?$", "default": ""}),
    ] = Field(default_factory=list[int])
    """Indices of further parts that the player plays together with it, as `1,2`."""
    usual_fingerings: bool = False
    """Take no fingering but the usual one of each note."""
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Which sequence of a MIDI file of format 2; the first when left out."""
    player: PlayerName = "trumpeter"
    """Who plays: a rig that holds the instrument."""
    handedness: Handedness = "right"
    """Which hand leads, where the instrument can be played so."""
    in_time: bool = False
    """The score is in time with the song already, as one is that was found in it: its seconds are the song's,
    and it is not looked for."""
    cast: Annotated[
        Literal["auto"] | Json[CastFields] | None,
        WithJsonSchema({"type": "string", "contentMediaType": "application/json"}),
    ] = None
    """Everybody who plays, as `PUT /sessions/{id}/cast` takes it, in place of part, transposition, written,
    octave_fit, joined_parts, usual_fingerings, player and handedness; `auto`, the default where none of these
    is there, gives a player to each part that the score has for the instruments that there are."""


TranscriptionStatus = Literal["searching", "found", "failed"]
TranscriptionFault = Literal["mix", "other"]


class TranscriptionLinks(WireModel):
    """Where the search for a recording's notes is, and what came of it."""

    self: str
    midi: str
    """The score as a MIDI file, once it is found."""


class Transcription(WireModel):
    """The search for the notes of a recording. Whoever has its id may take what is found, and end it."""

    id: str
    title: str
    status: TranscriptionStatus
    progress: float
    """0..1."""
    notes: int
    """How many were found."""
    has_beat: bool
    """Whether they tell a beat; where they do not, 120 a minute are written."""
    fault: TranscriptionFault | None
    """Why there is no score: `mix`, more than one line sounds; `other`, as `detail` says."""
    detail: str | None
    """The same in words."""
    links: TranscriptionLinks


class CastingSummary(WireModel):
    """What a player does, and how it came out."""

    part: int
    part_name: str
    instrument: str
    player: str
    seat: str
    seat_chosen: bool
    """Whether somebody chose the seat; otherwise it is by how many play."""
    transposition: int
    written: bool
    octave_fit: bool
    joined_parts: list[int]
    handedness: str
    usual_fingerings: bool
    sounding_transposition: int
    """Semitones by which the part is played away from the file's pitches."""
    notes: int
    """How many notes the player plays, one at a time."""
    playable: int
    """How many of these the instrument has."""
    reasons: list[str]
    """Why this part suits the instrument, or does not."""
    cast_because: list[str]
    """Why there is a player for it: what the part is for, and what it is beside the parts of those before."""


class Casting(CastingSummary):
    """What a player does, how it came out, and what else there is."""

    choices: list[PartChoice]
    """The parts that the instrument could play, best first."""


class TunePassage(WireModel):
    """A stretch in which one player has the tune."""

    start_s: float
    end_s: float
    """Where the next begins."""
    player: int
    """The player's place in the cast."""


class UnplayedPart(WireModel):
    """A part that nobody plays; it is heard."""

    part: int
    part_name: str
    reason: str


class CastSummary(WireModel):
    """Who plays what, in the order of the players, and why nobody plays the rest."""

    sequence: int
    auto: bool
    """Whether the score itself said who plays; false once somebody has chosen."""
    castings: list[CastingSummary]
    unplayed: list[UnplayedPart]
    """Every other part of the score, in its order."""


class Cast(WireModel):
    """Who plays what, in the order of the players, with what else each could play."""

    sequence: int
    auto: bool
    """Whether the score itself said who plays; false once somebody has chosen."""
    castings: list[Casting]
    unplayed: list[UnplayedPart]
    """Every other part of the score, in its order."""
    tune: list[TunePassage]
    """Who is heard above the others, from the beginning to the end: the higher, livelier, louder line."""


class ChartLine(WireModel):
    """How an instrument plays one note."""

    sounding_pitch: int
    written_pitch: int
    sounding_names: list[str]
    """One name, or of a black key both: the sharp, then the flat."""
    written_names: list[str]
    fingerings: list[list[int]]
    """The usual one first, then the alternates; each the valves that are down, ascending."""


class FileRole(WireModel):
    """What a file is, by what stands in it."""

    role: Literal["score", "song", "show"] | None
    """As what it can be sent; null: as nothing."""
    name: str
    """What it is: `a MIDI file`, `a PDF`."""
    advice: str
    """What to send in its place; empty where it can be sent."""


class InstrumentSummary(WireModel):
    """An instrument that somebody can play."""

    name: str
    title: str
    rig: str
    players: list[str]
    """The rigs that hold it."""
    handedness: list[str]
    """Which hand may lead."""
    clef: Literal["treble", "bass"]
    """The clef that it is written in."""
    valves: int
    """How many it has."""
    pieces: list[str]
    """What of it is struck, by name, as the drums of a kit; empty where it is not struck."""
    seat: str | None
    """Where it stands by itself: there is room for one of it. null where it stands with the others."""
    chart: list[ChartLine]
    """Every note that it has, from the lowest up."""


class InstrumentList(WireModel):
    """What a cast can be made of."""

    instruments: list[InstrumentSummary]
    seats: list[str]
    """Where players can stand; left and right are theirs."""
    max_players: int
    """How many play at once at most."""


class StanceList(WireModel):
    """A session's own stances."""

    stances: list[Stance]
    """In the order of the choices."""


class Tempo(WireModel):
    """A tempo and where it begins."""

    onset_beats: float
    onset_s: float
    bpm: float
    """Quarter notes a minute."""


class Metre(WireModel):
    """A time signature and where it begins."""

    onset_beats: float
    onset_s: float
    numerator: int
    denominator: int


class MusicKey(WireModel):
    """A key and where it begins."""

    onset_beats: float
    onset_s: float
    name: str
    """As the first player's part sounds: `E♭ major`; `no key` where the notes are in none."""
    fifths: int
    """Sharps of its signature; flats are negative."""
    written_name: str
    """As it stands in the first player's part."""
    written_fifths: int
    source: Literal["file", "notes", "none"]
    """Whether the file says it, or it is found from the notes."""


class SungSyllable(WireModel):
    """A syllable, and when it is sung."""

    onset_s: float
    text: str
    """With the blank after it, or before it, that stands between words."""


class LyricLine(WireModel):
    """A line of lyrics."""

    start_s: float
    """When its first syllable is sung."""
    end_s: float
    """When the next line begins, or it is over."""
    syllables: list[SungSyllable]


class ScoreText(WireModel):
    """Words at a place of the score."""

    onset_s: float
    onset_beats: float
    text: str


class Score(WireModel):
    """The score, as far as it is drawn and played."""

    title: str
    duration_s: float
    sequence: int
    part: int
    transposition: int
    written: bool
    octave_fit: bool
    joined_parts: list[int]
    """Further parts that the player plays together with it, ascending."""
    handedness: str
    usual_fingerings: bool
    parts: list[PartSummary]
    tempi: list[Tempo]
    metres: list[Metre]
    keys: list[MusicKey]
    bar_lines_s: list[float]
    notes: list[WireNote]
    """By onset; of one part alone with `?part=`."""
    lyrics: list[LyricLine]
    """Lines that the file has to be sung, by time."""
    markers: list[ScoreText]
    """Names of sections, rehearsal marks, by time."""
    texts: list[ScoreText]
    """Other words that the file has, by time."""
    warnings: list[Warned]


class ShowEdited(ShowState):
    """What came of an edit, an undo or a redo."""

    head: ShowHead
    """The show as it is now, but for its tracks: title, time, markers."""
    tracks: list[ShowTrack]
    """The tracks that changed, as the show holds them now; none with `Prefer: return=minimal`."""
    removed: list[str]
    """Parameters whose tracks are gone."""


class KeyframeList(WireModel):
    """The keyframes of one track, in their order."""

    keyframes: list[ShowKeyframe]


class ShowWarnings(WireModel):
    """What of a show has no effect in the piece that it is put on, and why. Nothing of it is dropped."""

    warnings: list[Warned]
    """Each with the parameter, or `markers`, as its place."""


class ShowSummary(WireModel):
    """A show in the library."""

    name: str
    title: str
    description: str
    href: str


class ShowLibrary(WireModel):
    """The bundled shows, each to be fetched and put into a session of one's own."""

    shows: list[ShowSummary]


class RigSummary(WireModel):
    """A rig in the list."""

    name: str
    href: str


class RigList(WireModel):
    """The rigs that this server has."""

    rigs: list[RigSummary]


class ShowParameter(WireModel):
    """A parameter that keyframes can move."""

    path: str
    type: TypeName
    unit: str
    minimum: float | None
    maximum: float | None
    default: Any
    choices: list[str]
    length: int
    """How many floats it is in a frame."""
    blend: bool
    interpolations: list[str]
    """What its keyframes may name."""
    documentation: str


class InterpolationOption(WireModel):
    """A number, or several, that a keyframe of an interpolation may set."""

    name: str
    default: float | list[float]
    minimum: list[float | None]
    maximum: list[float | None]
    documentation: str


class Interpolation(WireModel):
    """A way to come to a keyframe from the one before."""

    name: str
    documentation: str
    options: list[InterpolationOption]
    tangents: str | None
    """Where its slopes come from, for splines."""


class ShowParameterList(WireModel):
    """Every parameter in the frame's order, and every interpolation."""

    parameters: list[ShowParameter]
    """What a show can move. The first player's paths stand alone, the second's begin with `players/2/`."""
    streamed: list[ShowParameter]
    """What the players give to a frame beside the show, such as valves; no keyframe moves it."""
    interpolations: list[Interpolation]


class LightMood(WireModel):
    """A light to choose; the edit `apply_look` takes its `values` and `rest`."""

    name: str
    title: str
    values: dict[str, float | str | list[float]]
    """Parameters, each with its value."""
    rest: list[str]
    """Parameters, or beginnings of their paths, that go back to their defaults where they have no value."""


class LightMoodList(WireModel):
    """Lights to choose without programming."""

    moods: list[LightMood]


class Example(WireModel):
    """A bundled piece: its files, to be posted as a session of one's own."""

    name: str
    title: str
    score: str
    song: str | None
    show: str | None


class ExampleList(WireModel):
    """The bundled pieces; the first is the one for a first visit."""

    examples: list[Example]


class Unready(WireModel):
    """One thing without which the server is not ready."""

    reason: Literal[
        "starting",
        "data-directory",
        "data-full",
        "database",
        "bus",
        "workers",
        "soundfont",
        "page",
        "event-loop",
        "ending",
    ]
    detail: str


class Health(WireModel):
    """Liveness and readiness."""

    status: str
    """`ok` while it can play, else `not-ready`."""
    ready: bool
    not_ready: list[Unready] = Field(default_factory=list[Unready])
    """What keeps it from being ready."""
    version: str
    streams: list[str]
    """The subprotocols that it speaks."""
    server_time_s: float
