"""JSON text, read and written by orjson."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import orjson

Written = orjson.Fragment
"""A part of a document that is written already; it stands in what `json_text` writes as it is."""


def json_text(document: Any) -> bytes:
    """A document as JSON text, UTF-8; tuples become lists.

    Raises:
        TypeError: It holds something that JSON has not.
    """
    # What orjson returns keeps the buffer that it was written in, a kilobyte for the shortest text; a show
    # keeps one text for each of its keyframes.
    return memoryview(orjson.dumps(document)).tobytes()


def with_list(head: Mapping[str, Any], name: str, entries: Sequence[bytes]) -> bytes:
    """An object as JSON text, with a list last whose entries are written already.

    They are only copied, which lets other threads go on meanwhile; orjson would look through each of them.

    Args:
        head: The object's other fields, one at least.
        name: The list's.
        entries: Each as JSON text.
    """
    parts = [json_text(dict(head))[:-1], b",", json_text(name), b":["]
    # Joined once: a list of half of a large show would be in memory twice.
    for entry in entries:
        parts += (entry, b",")
    if entries:
        parts.pop()
    parts.append(b"]}")
    return b"".join(parts)


def read_json(text: bytes) -> Any:
    """Read JSON text, in UTF-8 or in what else JSON may come in.

    Raises:
        ValueError: It is none; the message says where it ends to be.
    """
    try:
        return orjson.loads(text)
    except orjson.JSONDecodeError:
        # Byte order marks, UTF-16, numbers beyond all bounds: the standard library takes them, or says more.
        try:
            return json.loads(text)
        except RecursionError:
            raise ValueError("lists and objects stand within one another too deep") from None
