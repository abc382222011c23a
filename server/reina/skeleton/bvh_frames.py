"""The numbers after a BVH file's MOTION: as many as are there, whatever number of frames is announced."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from reina.skeleton.bvh_tokens import LARGEST, MAX_DIGITS, Tokens, shown
from reina.skeleton.clip_warning import ClipWarning

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.rotations.arrays import FloatArray

MAX_VALUES = 50_000_000
_PIECE = 1 << 16
"""Characters that are read at a time: a large file takes no memory for its words, and lets others run."""

_SPACE = re.compile(r"\s", re.ASCII)
_WORD = re.compile(r"\S+", re.ASCII)
_OF_NUMBERS = re.compile(r"[-+.0-9eE\s]*", re.ASCII)


def read_frames(
    tokens: Tokens, channels: int, announced: int, announced_at: int
) -> tuple[FloatArray, list[ClipWarning]]:
    """The frames from where the tokens are to the end of the file.

    Args:
        tokens: Behind the frame time.
        channels: How many values a frame has.
        announced: How many frames the file says it has.
        announced_at: Where it says so.

    Returns:
        Values ``(F, channels)``, and what is not as announced.

    Raises:
        BvhError: What stands there is no number, or lines and frames do not fit together.
    """
    warnings: list[ClipWarning] = []
    begin = tokens.at
    values, end = _numbers(tokens, channels * announced) if channels else (np.zeros(0), begin)
    if channels and values.size != channels * announced:
        _check_lines(tokens, begin, end, channels)
    frames, left = divmod(values.size, channels) if channels else (0, 0)
    if frames != announced:
        message = f"{announced} frames are announced, {frames} are there, which are read"
        if not channels:
            message = f"{announced} frames are announced, but no joint has channels that could move it"
        warnings.append(ClipWarning("frame_count", tokens.line(announced_at), message))
    if left:
        last = tokens.text.rfind("\n", 0, len(tokens.text[:end].rstrip())) + 1
        message = f"the last frame has {left} of {channels} values and is left out"
        warnings.append(ClipWarning("incomplete_frame", tokens.line(last), message))
    rest = _WORD.search(tokens.text, end)
    if rest:
        line = tokens.text[rest.start() : rest.start() + 100].partition("\n")[0]
        message = f"what stands behind the last frame is left out: {shown(line)}"
        warnings.append(ClipWarning("trailing_text", tokens.line(rest.start()), message))
    return values[: frames * channels].reshape(frames, channels), warnings


def _numbers(tokens: Tokens, wanted: int) -> tuple[FloatArray, int]:
    """Numbers up to the end, or, once as many as are wanted are there, to what is none; and where that is."""
    count = 0
    pieces: list[FloatArray] = [np.zeros(0)]
    for begin, end in _pieces(tokens.text, tokens.at, len(tokens.text)):
        piece = _plain_numbers(tokens.text[begin:end])
        stopped = end
        if piece is None:
            piece, stopped = _numbers_before(tokens, begin, end, wanted - count)
        pieces.append(piece)
        count += piece.size
        if count > MAX_VALUES:
            tokens.fail(f"the file has more than {MAX_VALUES} values, which is more than Reina reads", begin)
        if stopped < end:
            return np.concatenate(pieces), stopped
    return np.concatenate(pieces), len(tokens.text)


def _plain_numbers(text: str) -> FloatArray | None:
    """Numbers between spaces; None where there is anything else."""
    if not _OF_NUMBERS.fullmatch(text):
        return None
    words = text.split()
    if max(map(len, words), default=0) > MAX_DIGITS:
        return None
    try:
        values = np.array([float(word) for word in words])
    except ValueError:
        return None
    return values if np.all(np.abs(values) <= LARGEST) else None


def _numbers_before(tokens: Tokens, begin: int, end: int, wanted: int) -> tuple[FloatArray, int]:
    """The numbers before what is none, and where that is; to be refused where numbers are still wanted."""
    values: list[float] = []
    for found in _WORD.finditer(tokens.text, begin, end):
        if len(values) >= wanted and _plain_numbers(found[0]) is None:
            return np.array(values), found.start()
        values.append(tokens.number_of(found[0], found.start()))
    raise AssertionError("every word is a number after all")


def _check_lines(tokens: Tokens, begin: int, end: int, channels: int) -> None:
    """Refuse a file in which a frame ends in the middle of a line: one has too few values or too many."""
    text, began, lines, held, filled = tokens.text, begin, 0, 0, 0
    word = _WORD.search(text, begin, end)
    while word:
        at = word.start()
        line_end = text.find("\n", at, end)
        line_end = end if line_end < 0 else line_end
        found = sum(len(text[first:last].split()) for first, last in _pieces(text, at, line_end))
        if filled and filled + found > channels:
            here = "this line" if lines == 1 else "the lines from here"
            tokens.fail(f"a frame has {channels} values, {here} {held}", began)
        if not filled:
            began, lines, held = at, 0, 0
        lines, held = lines + 1, held + found
        filled = (filled + found) % channels
        word = _WORD.search(text, line_end, end)


def _pieces(text: str, at: int, end: int) -> Iterator[tuple[int, int]]:
    """Where pieces of a text begin and end, cut between words."""
    while at < end:
        found = _SPACE.search(text, at + _PIECE, end) if end - at > _PIECE else None
        piece_end = found.start() if found else end
        yield at, piece_end
        at = piece_end
