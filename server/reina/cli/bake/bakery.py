"""Bakes scores on a cluster: what is sent out, what comes back, and what is told of it."""

from __future__ import annotations

import hashlib
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import reina
from reina.cli.bake import work
from reina.cli.bake.library import VERSION, Baked, Document
from reina.cli.bake.work import AT_ONCE, BLOCKS, SHOW, OtherReinaError, Outline, ScoreOrder, said_of
from reina.errors import InputError
from reina.sound.rendered import SONG
from reina.system.cluster import ClusterError, Work, outcomes

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from distributed import Client

    from reina.cli.bake.library import Draft, Library

PARTS = ("show", "blocks", "bvh", "sound")
"""What is made of a score."""


@dataclass(frozen=True)
class Recipe:
    """What is made of each score.

    Attributes:
        parts: Of `PARTS`.
        instrument: What plays; None: who plays when it is opened.
        maker: `work.maker` here.
        soundfont: What sound is made with; None where none is.
    """

    parts: frozenset[str]
    instrument: str | None
    maker: str
    soundfont: str | None


@dataclass
class Summary:
    """What became of the scores, by their paths."""

    made: list[str] = field(default_factory=list[str])
    there: list[str] = field(default_factory=list[str])
    failed: dict[str, str] = field(default_factory=dict[str, str])

    @property
    def done(self) -> int:
        """How many need nothing more."""
        return len(self.made) + len(self.there) + len(self.failed)


@dataclass(frozen=True)
class _Found:
    """What there is of a score.

    Attributes:
        name: Its path in the folder of scores.
        data: Its file.
        source: What its manifest says that it is made of.
        baked: What an earlier bake has made of it.
        kept: The parts of that which are as they would be made now.
        wanted: The parts that are still to be made.
    """

    name: str
    data: bytes
    source: Document
    baked: Baked | None
    kept: dict[str, Document]
    wanted: frozenset[str]


@dataclass
class _Piece:
    """A score that is being baked.

    Attributes:
        found: The score.
        order: What the workers are sent of it.
        draft: What is made of it so far.
        open: How many pieces of work are not done.
        outline: What is known of it once it is planned.
        silent: Why there is no sound.
        failed: Whether something of it could not be made.
    """

    found: _Found
    order: ScoreOrder
    draft: Draft
    open: int = 0
    outline: Outline | None = None
    silent: str = ""
    failed: bool = False


@dataclass(frozen=True)
class _Step:
    """A piece of work of a score's."""

    piece: _Piece
    what: str
    """``begin``, ``blocks``, ``bvh`` or ``sound``."""
    player: int = 0
    first: int = 0


class Bakery:
    """Bakes scores, a few at a time.

    Args:
        library: Where it goes.
        recipe: What is made.
        folder: Where the scores are.
        told: Called whenever a score is done, and with what is to be said, or an empty text.
    """

    def __init__(
        self, library: Library, recipe: Recipe, folder: Path, told: Callable[[Summary, str], None]
    ) -> None:
        self._library = library
        self._recipe = recipe
        self._folder = folder
        self._told = told
        self.summary = Summary()
        self._waiting: deque[Work[_Step]] = deque()

    def missing(self, scores: Sequence[Path]) -> list[Path]:
        """The scores of which something is still to be made; those that cannot be read have failed."""
        return [path for path in scores if (found := self._found(path)) and found.wanted]

    def bake(self, client: Client, scores: Sequence[Path]) -> None:
        """Bake scores.

        Args:
            client: The cluster that works.
            scores: Their files.

        Raises:
            ClusterError: There is nobody to work any more.
            InputError: A worker would make something else than this Reina.
            OSError: The output cannot be written.
        """
        left = deque(scores)

        def another() -> Work[_Step] | None:
            # A score is read when its turn comes, and no sooner.
            while left and not self._waiting:
                self._open(left.popleft())
            return self._waiting.popleft() if self._waiting else None

        for done, result, error in outcomes(client, another, lambda line: self._told(self.summary, line)):
            self._take(done.about, result, error)

    def _found(self, path: Path) -> _Found | None:
        """What there is of a score; None where it cannot be read, which is told."""
        recipe, name = self._recipe, path.relative_to(self._folder).as_posix()
        try:
            data = path.read_bytes()
        except OSError as error:
            self._fail(name, error.strerror or str(error))
            return None
        score = {"file": name, "sha256": hashlib.sha256(data).hexdigest(), "bytes": len(data)}
        source: Document = {"made_by": recipe.maker, "score": score, "instrument": recipe.instrument}
        baked = Baked.read(self._library.folder(name))
        kept = baked.parts_of(source, recipe.soundfont) if baked else {}
        found = _Found(name, data, source, baked, kept, recipe.parts - kept.keys())
        if not found.wanted:
            self.summary.there.append(name)
            self._told(self.summary, "")
        return found

    def _open(self, path: Path) -> None:
        found = self._found(path)
        if found is not None and found.wanted:
            order = ScoreOrder(found.data, path.name, self._recipe.instrument, self._recipe.maker)
            piece = _Piece(found, order, self._library.draft())
            self._send(_Step(piece, "begin"), work.begin, found.wanted)

    def _send(self, step: _Step, function: Callable[..., Any], *arguments: object) -> None:
        step.piece.open += 1
        # What belongs to a score that was begun goes before others, so that few are open.
        self._waiting.appendleft(Work(step, function, (step.piece.order, *arguments)))

    def _take(self, step: _Step, result: Any, error: BaseException | None) -> None:
        piece = step.piece
        piece.open -= 1
        if isinstance(error, OtherReinaError):
            raise error
        if error is not None and step.what == "sound" and type(error) is InputError:
            piece.silent = str(error)
        elif error is not None:
            self._give_up(piece, said_of(error))
        elif not piece.failed:
            self._keep(step, result)
        if not piece.open:
            if piece.failed:
                piece.draft.drop()
            else:
                self._finish(piece)

    def _give_up(self, piece: _Piece, why: str) -> None:
        if not piece.failed:
            piece.failed = True
            self._fail(piece.found.name, why)

    def _fail(self, name: str, why: str) -> None:
        self.summary.failed[name] = why
        self._told(self.summary, f"{name}: {why}")

    def _keep(self, step: _Step, result: Any) -> None:
        piece = step.piece
        match step.what:
            case "begin":
                outline, files = result
                piece.outline = outline
                self._go_on(piece, outline)
            case "blocks":
                files = result
            case "bvh":
                text, angles = result
                files = {work.motion_file(step.player): text}
                self._send_motion(piece, step.player, step.first + AT_ONCE, angles)
            case _:
                files = {SONG: result}
        for name, data in files.items():
            piece.draft.add(name, data)

    def _go_on(self, piece: _Piece, outline: Outline) -> None:
        if outline.blocks > AT_ONCE:
            if "bvh" in piece.found.wanted:
                for player in range(len(outline.players)):
                    self._send_motion(piece, player, 0, None)
            if "blocks" in piece.found.wanted:
                for first in range(0, outline.blocks, AT_ONCE):
                    end = min(first + AT_ONCE, outline.blocks)
                    self._send(_Step(piece, "blocks", first=first), work.blocks, first, end)
        if "sound" in piece.found.wanted:
            self._send(_Step(piece, "sound"), work.song, self._recipe.soundfont)

    def _send_motion(self, piece: _Piece, player: int, first: int, angles: object) -> None:
        """The next stretch of a player's BVH, whose angles go on from those before."""
        outline = piece.outline
        if outline is not None and first < outline.blocks:
            end = min(first + AT_ONCE, outline.blocks)
            step = _Step(piece, "bvh", player, first)
            self._send(step, work.motion, player, first, end, angles)

    def _finish(self, piece: _Piece) -> None:
        for part in piece.found.kept.values():
            if piece.found.baked is not None:
                piece.draft.take(piece.found.baked, part)
        self._library.put(piece.draft, piece.found.name, self._manifest(piece))
        self.summary.made.append(piece.found.name)
        self._told(self.summary, "")

    def _manifest(self, piece: _Piece) -> Document:
        outline = piece.outline
        if outline is None:
            raise ClusterError(f"{piece.found.name} was never planned")
        parts = dict(piece.found.kept)
        for part in piece.found.wanted:
            parts[part] = {"files": _of_part(part, piece.draft.sizes)}
            if part == BLOCKS:
                parts[part] |= {"revision": outline.revision, "fps": outline.fps, "count": outline.blocks}
            if part == "sound":
                parts[part]["soundfont"] = self._recipe.soundfont
        warnings = [
            {"kind": kind, "place": place, "message": message} for kind, place, message in outline.warnings
        ]
        silent = piece.silent or parts.get("sound", {}).get("silent", "")
        if silent:
            parts["sound"]["silent"] = silent
        return {
            "version": VERSION,
            "reina": reina.__version__,
            **piece.found.source,
            "title": outline.title,
            "duration_s": outline.duration_s,
            "players": [
                {"instrument": instrument, "part": part, "motion": work.motion_file(number)}
                for number, (instrument, part) in enumerate(outline.players)
            ],
            "warnings": warnings,
            "parts": {part: parts[part] for part in PARTS if part in parts},
        }


def _of_part(part: str, sizes: dict[str, int]) -> dict[str, int]:
    """The files of a part among those that were written, in whatever order that was."""
    endings = {"show": SHOW, "bvh": ".bvh", "sound": SONG}
    return {
        name: size
        for name, size in sorted(sizes.items(), key=lambda one: (len(one[0]), one[0]))
        if (name.startswith(f"{BLOCKS}/") if part == BLOCKS else name.endswith(endings[part]))
    }
