"""The kinds of file that `fuzz_readers.py` reads: what it begins from, what makes it worse, its check."""

from __future__ import annotations

import gzip
import io
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tests.mutations import mutate
from tests.unit.music.musicxml.musicxml_mutations import musicxml_seeds, mutate_musicxml
from tests.unit.music.mutations import json_seeds, midi_seeds, mutate_json, mutate_midi
from tests.unit.sessions.score_checks import check_score_played, stage
from tests.unit.show import show_mutations
from tests.unit.skeleton import test_fuzz as motion
from tests.unit.sound.recording import recording_mutations

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

ROOT = Path(__file__).parents[2]
CASES = ROOT / "tests" / "cases"
SCORES = ROOT / "examples" / "scores"


@dataclass(frozen=True)
class Kind:
    """A kind of file.

    Attributes:
        seeds: Files to begin from.
        mutate: Makes a file worse.
        check: Reads a file and does with it what Reina does; False if it is refused, and an exception, which
            may be an `AssertionError`, for everything that must not be.
        prepare: Loads what `check` needs.
    """

    seeds: Callable[[], tuple[bytes, ...]]
    mutate: Callable[[bytes, random.Random], bytes]
    check: Callable[[bytes], bool]
    prepare: Callable[[], object] = lambda: None


def _files(folder: Path, pattern: str) -> list[bytes]:
    return [path.read_bytes() for path in sorted(folder.glob(pattern))]


def _midi() -> tuple[bytes, ...]:
    taps = (SCORES / "taps.mid").read_bytes()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("taps.mid", taps)
    packed = [gzip.compress(taps, mtime=0), stream.getvalue()]
    return (*midi_seeds(), *_files(CASES, "*.mid"), *_files(SCORES, "*.mid"), *packed)


def _json() -> tuple[bytes, ...]:
    return (*(4 * json_seeds()), *_files(CASES, "json-*-score.json"), *_files(SCORES, "*.json"))


def _mutate_motion(data: bytes, rng: random.Random) -> bytes:
    return mutate(data, motion.BVH, rng)


KINDS = {
    "midi": Kind(_midi, mutate_midi, check_score_played, stage),
    "musicxml": Kind(musicxml_seeds, mutate_musicxml, check_score_played, stage),
    "json": Kind(_json, mutate_json, check_score_played, stage),
    "bvh": Kind(motion.seeds, _mutate_motion, motion.check_bvh),
    "show": Kind(show_mutations.seeds, show_mutations.mutate_show, show_mutations.check_show),
    "recording": Kind(
        recording_mutations.seeds, recording_mutations.mutate_recording, recording_mutations.check_recording
    ),
}
