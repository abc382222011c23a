from collections.abc import Iterable, Iterator
from os import PathLike
from typing import IO, Any

class Message:
    type: str
    time: float
    channel: int
    note: int
    velocity: int
    control: int
    value: int
    program: int
    pitch: int
    def __init__(self, type: str, **attributes: Any) -> None: ...
    def copy(self, **overrides: Any) -> Message: ...
    def bytes(self) -> list[int]: ...

class MetaMessage:
    type: str
    time: float
    tempo: int
    name: str
    numerator: int
    denominator: int
    def __init__(self, type: str, **attributes: Any) -> None: ...
    def copy(self, **overrides: Any) -> MetaMessage: ...

class MidiTrack(list[Message | MetaMessage]):
    name: str
    def __init__(self, messages: Iterable[Message | MetaMessage] = ...) -> None: ...

class MidiFile:
    type: int
    ticks_per_beat: int
    tracks: list[MidiTrack]
    length: float
    def __init__(
        self,
        filename: str | PathLike[str] | None = ...,
        file: IO[bytes] | None = ...,
        type: int = ...,
        ticks_per_beat: int = ...,
        charset: str = ...,
        debug: bool = ...,
        clip: bool = ...,
        tracks: list[MidiTrack] | None = ...,
    ) -> None: ...
    def add_track(self, name: str | None = ...) -> MidiTrack: ...
    def save(self, filename: str | PathLike[str] | None = ..., file: IO[bytes] | None = ...) -> None: ...
    def __iter__(self) -> Iterator[Message | MetaMessage]: ...

def bpm2tempo(bpm: float, time_signature: tuple[int, int] = ...) -> int: ...
def tempo2bpm(tempo: int, time_signature: tuple[int, int] = ...) -> float: ...
def tick2second(tick: float, ticks_per_beat: int, tempo: int) -> float: ...
def merge_tracks(tracks: Iterable[MidiTrack], skip_checks: bool = ...) -> MidiTrack: ...
