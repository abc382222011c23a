"""Whatever the bytes, a motion file is read, drawn and written, or refused with the reader's own error."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.mutations import Format, mutated

from reina.lab import clip_points
from reina.skeleton import BvhError, MotionClip, PositionMeaning, read_bvh, write_bvh

ROOT = Path(__file__).parents[3]
FRAMES = 3

BVH = Format(
    interesting=b"\0\t\n\r ,.-+:_{}09eE#\x1a\x85\xa0\xc2\xff",
    tokens=(
        *(word.encode() for word in ("HIERARCHY", "ROOT a", "JOINT a", "End Site", "MOTION", "OFFSET 0 1 0")),
        *(
            word.encode()
            for word in ("CHANNELS 1 Xposition", "CHANNELS 3", "Zrotation", "Frames: 9", "²", "１")
        ),
        *(
            b"{",
            b"}",
            b"{ }",
            b"\n",
            b"\r\n",
            b"\xff\xfe",
            b"\xef\xbb\xbf",
            b"nan",
            b"-inf",
            b"1_0",
            b"1e999",
        ),
        b"Frames: 1000000000\n",
        b"Frame Time: 1e308\n",
    ),
    numbers=(
        *(b"7", b"12", b"-3", b"0", b".5", b"1e-320", b"6.02e2", b" 1", b"3\n", b"90.0", b"-45", b"1000"),
        *(b"1e308", b"1e12", b"9999999999", b"9" * 200, b"1,5", b"-"),
    ),
)
"""What means something to a reader of BVH."""


@cache
def seeds() -> tuple[bytes, ...]:
    """The cases but the longest, and the shipped clips' hierarchies with their first frames."""
    cases = [path.read_bytes() for path in sorted((ROOT / "tests" / "cases").glob("bvh-*.bvh"))]
    clips: list[bytes] = []
    for path in sorted((ROOT / "rigs").glob("*/clips/*.bvh")):
        head, time, rows = path.read_bytes().partition(b"Frame Time: 0.04166667\n")
        clips.append(head + time + b"\n".join(rows.split(b"\n")[:FRAMES]))
    return (*(2 * [data for data in cases if len(data) < 10_000]), *clips)


def read(data: bytes, meaning: PositionMeaning) -> MotionClip | None:
    """A file's clip; None if it is refused, with the line and in few words."""
    try:
        return read_bvh(data, positions=meaning)
    except BvhError as error:
        told = error
    assert told.location is not None
    assert told.location.startswith("line ")
    assert len(told.detail) < 400
    return None


def check_bvh(data: bytes) -> bool:
    """Read a file, lay it out, write it, and see that it is the same motion then; False if it is refused."""
    clips = [clip for meaning in ("replace", "add") if (clip := read(data, meaning))]
    for clip in clips:
        assert clip.values.shape == (len(clip), sum(map(len, clip.channels)))
        assert len(set(clip.names)) == len(clip.names)
        assert all(clip.names)
        assert 0.0 < len(clip) * clip.frame_time_s < 1e12 or len(clip) == 0
        places = clip_points(clip).positions
        assert np.all(np.isfinite(places.astype(np.float32)))
        again = read_bvh(write_bvh(clip.without_still_positions()))
        assert len(again) == len(clip)
        assert sorted(again.names) == sorted(clip.names)
        written = clip_points(again).positions
        by_name = [again.names.index(name) for name in clip.names]
        size = float(np.abs(places).max())
        np.testing.assert_allclose(
            written[:, by_name],
            places[:, : len(clip.names)],
            rtol=0,
            atol=1e-5 * len(clip.names) + 1e-5 * size,
        )
    return bool(clips)


def test_the_seeds_are_read() -> None:
    assert all(check_bvh(seed) for seed in seeds())


def test_mutated_files_give_a_clip_or_the_readers_own_error() -> None:
    sound = sum(check_bvh(data) for data in mutated(seeds(), BVH, 2_500, seed=20_261_129))
    assert sound > 180


@settings(max_examples=200)
@given(st.binary(max_size=200))
def test_any_bytes_as_motion_give_a_clip_or_the_readers_own_error(data: bytes) -> None:
    check_bvh(
        b"HIERARCHY ROOT a { CHANNELS 2 Xposition Zrotation } MOTION Frames: 2 Frame Time: 0.1\n" + data
    )


WORDS = (
    *("ROOT", "JOINT", "End", "Site", "OFFSET", "CHANNELS", "Xposition", "Zrotation", "{", "}", "\n"),
    *("MOTION", "Frames", ":", "Frame", "Time", "0", "1", "2.5", "a"),
)


@settings(max_examples=300)
@given(st.lists(st.sampled_from(WORDS), max_size=40))
def test_words_in_any_order_give_a_clip_or_the_readers_own_error(words: list[str]) -> None:
    check_bvh(b"HIERARCHY ROOT a { " + " ".join(words).encode())
