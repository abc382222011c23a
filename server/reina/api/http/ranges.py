"""Ranges of bytes, as requests ask for them (RFC 9110, 14)."""

import re

MAX_RANGES = 32
"""Whoever asks for more of one file at once is sent the whole."""
MAX_DIGITS = 18
"""No file has a position with more."""
_RANGE = re.compile(r"([0-9]*)-([0-9]*)")


def byte_ranges(header: str, size: int) -> list[tuple[int, int]] | None:
    """The ranges of a file that a `Range` header asks for.

    Args:
        header: ``"bytes=0-99, -5"``.
        size: Of the file, bytes.

    Returns:
        First and last byte of each range that can be satisfied; an empty list when none can. None when the
        header is to be ignored and the file sent whole: another unit, a malformed range, too many of them,
        or the end of a file that is empty.
    """
    unit, _, listed = header.partition("=")
    # Empty elements of a list are passed over (5.6.1.2).
    specified = [spec for spec in (part.strip(" \t") for part in listed.split(",")) if spec]
    if unit.strip(" \t").lower() != "bytes" or not 0 < len(specified) <= MAX_RANGES:
        return None
    ranges: list[tuple[int, int]] = []
    for spec in specified:
        match = _RANGE.fullmatch(spec)
        if match is None or spec == "-":
            return None
        first, last = (_position(digits, size) if digits else None for digits in match.groups())
        if first is None:
            if size == 0 and last:
                return None
            ranges += [(max(size - last, 0), size - 1)] if last else []
        elif last is not None and last < first:
            return None
        elif first < size:
            ranges.append((first, size - 1 if last is None else min(last, size - 1)))
    return ranges


def _position(digits: str, size: int) -> int:
    """A number of any length; beyond the file there is no telling them apart."""
    significant = digits.lstrip("0") or "0"
    return size if len(significant) > MAX_DIGITS else int(significant)
