"""What the workers of `reina bake` do: functions of bytes, wherever they run."""

from __future__ import annotations

import hashlib
import math
import tempfile
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from reina.api.settings import Settings
from reina.errors import InputError
from reina.instruments import Cast, Casting
from reina.music import read_score
from reina.performance import BLOCK_FRAMES, TAIL_S
from reina.sessions.frames import EncodedFrames
from reina.sessions.frames_revision import revision_of
from reina.sessions.motion_export import BvhExport, player_skeleton
from reina.sessions.packed_blocks import PackedBlocks
from reina.sessions.production import Production
from reina.sessions.schedule import frame_from
from reina.sessions.show_revision import ShowRevision
from reina.sessions.stage import Stage
from reina.sound.font import soundfont_id
from reina.sound.hearing import AS_WRITTEN
from reina.sound.plan import plan_sound
from reina.sound.provide_soundfont import own_soundfont
from reina.sound.render import render_whole
from reina.sound.rendered import SONG
from reina.system.digest import code_digest
from reina.system.failure import failure_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

AT_ONCE = 300
"""Blocks that one piece of work makes at most: five minutes, a second or three of a core."""
SHOW = "show.json"
BLOCKS = "blocks"

Files = dict[str, bytes]
"""What is made, by its path in the piece's folder."""


class OtherReinaError(InputError):
    """A worker would make something else than whoever asks: nothing can be made there."""


@dataclass(frozen=True)
class ScoreOrder:
    """A score that is to be baked.

    Attributes:
        data: Its file.
        filename: What the file is called.
        instrument: What plays it; None: who plays when it is opened.
        maker: `maker` of whoever asks.
    """

    data: bytes
    filename: str
    instrument: str | None
    maker: str


@dataclass(frozen=True)
class Outline:
    """What is known of a score when it has been planned.

    Attributes:
        title: What it is called.
        duration_s: How long its session would play.
        revision: What its frames are of, 16 hexadecimal digits.
        fps: Frames a second.
        blocks: How many packed blocks it has.
        players: Each player's instrument and part.
        warnings: Kind, place and message of each.
    """

    title: str
    duration_s: float
    revision: str
    fps: int
    blocks: int
    players: tuple[tuple[str, int], ...]
    warnings: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True)
class _Planned:
    production: Production
    show: ShowRevision
    outline: Outline


def maker() -> str:
    """What says that two make the same of the same score: of the code and the rigs."""
    return hashlib.sha256(f"{code_digest()} {_stage().digest}".encode()).hexdigest()


def begin(order: ScoreOrder, parts: frozenset[str]) -> tuple[Outline, Files]:
    """Plan a score, and make of it what is quickly made.

    Args:
        order: The score.
        parts: What is wanted: ``show``, and of a short one (`AT_ONCE`) ``blocks`` and ``bvh``.

    Raises:
        InputError: It cannot be read or played, or this is another Reina.
    """
    planned = _planned(order)
    files: Files = {}
    if "show" in parts:
        files[SHOW] = planned.show.text.text()
    if planned.outline.blocks <= AT_ONCE:
        if "blocks" in parts:
            files |= blocks(order, 0, planned.outline.blocks)
        if "bvh" in parts:
            for player in range(len(planned.outline.players)):
                files[motion_file(player)] = motion(order, player, 0, planned.outline.blocks)[0]
    return planned.outline, files


def blocks(order: ScoreOrder, first: int, end: int) -> Files:
    """Packed blocks `first` ... `end` - 1, the very bytes that a server answers with."""
    planned = _planned(order)
    production = planned.production
    frames = EncodedFrames(production.performance, production.manifest, kept=1)
    packed = PackedBlocks(frames, production.performance.layout, int(planned.outline.revision, 16), kept=1)
    try:
        return {f"{BLOCKS}/{packed.revision}/{n}": packed.block(n, "packed") for n in range(first, end)}
    finally:
        packed.forget()


def motion(
    order: ScoreOrder, player: int, first: int, end: int, angles: NDArray[np.float64] | None = None
) -> tuple[bytes, NDArray[np.float64] | None]:
    """The lines of a player's BVH that blocks `first` ... `end` - 1 have.

    Args:
        order: The score.
        player: Whose, the first being 0.
        first: The first block.
        end: The block before which it ends.
        angles: What was returned with the lines before.

    Returns:
        The text, and what the lines that follow are to be given.
    """
    planned = _planned(order)
    production, outline = planned.production, planned.outline
    export = BvhExport(
        production,
        player_skeleton(production, player),
        0,
        frame_from(outline.duration_s, outline.fps),
        angles=angles,
    )
    wanted = [block for block in export.blocks if first <= block < end]
    return "".join(map(export.text, wanted)).encode(), export.angles


def song(order: ScoreOrder, soundfont: str) -> bytes:
    """The sound of a score as FLAC, as a server would render it.

    Args:
        order: The score.
        soundfont: `soundfont_id` of whoever asks.

    Raises:
        InputError: It is longer than is rendered, or nothing of it is a pitch.
        OtherReinaError: Another soundfont is here.
        SoundError: There is nothing to render with.
    """
    production = _planned(order).production
    path = own_soundfont()
    if soundfont_id(path) != soundfont:
        raise OtherReinaError(f"a worker has another soundfont, {path}; every machine needs the same")
    plan = plan_sound(production.score, production.sounding, transposition=AS_WRITTEN.transposition)
    with tempfile.TemporaryDirectory(prefix="reina-bake-") as folder:
        whole = Path(folder) / SONG
        render_whole(plan, path.read_bytes(), whole)
        return whole.read_bytes()


def motion_file(player: int) -> str:
    """What a player's BVH is called, the first being 0."""
    return f"player-{player + 1}.bvh"


def said_of(error: BaseException) -> str:
    """What went wrong, in a line, for whoever reads what failed."""
    if isinstance(error, InputError):
        return str(error)
    failure = failure_of(error)
    return f"a mistake of Reina's: {failure.kind}: {failure.message} ({failure.place})"


@cache
def _stage() -> Stage:
    return Stage.load(Settings().rigs_dir)


@lru_cache(maxsize=2)
def _planned(order: ScoreOrder) -> _Planned:
    """A score as a server plans it when it is opened: what one worker is asked for next, mostly."""
    if order.maker != maker():
        raise OtherReinaError(
            "a worker has another version of Reina, or other rigs; every machine needs the same"
        )
    score = read_score(order.data, filename=order.filename)
    cast = Cast(auto=True) if order.instrument is None else _alone(order.instrument)
    production = Production.plan(_stage(), score, cast=cast)
    show = ShowRevision.begin(production.show)
    digest = hashlib.sha256(order.data).hexdigest()
    revision = revision_of(production.stage, [digest], production.cast, show)
    duration_s, fps = production.score.duration_s + TAIL_S, production.manifest.fps
    outline = Outline(
        title=score.title,
        duration_s=duration_s,
        revision=f"{revision:016x}",
        fps=fps,
        blocks=math.floor(duration_s * fps) // BLOCK_FRAMES + 1,
        players=tuple((one.instrument.name, one.played.part) for one in production.performers),
        warnings=tuple((one.kind, str(one.place), one.message) for one in production.warnings),
    )
    return _Planned(production, show, outline)


def _alone(instrument: str) -> Cast:
    """One who plays an instrument, and the part that suits it best."""
    players = _stage().players(instrument)
    casting = Casting(instrument=instrument)
    return Cast((replace(casting, player=players[0]) if players else casting,))
