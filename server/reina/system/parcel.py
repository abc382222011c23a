"""Python objects on their way between the server's processes.

What arrays hold travels beside the pickle (PEP 574): it is copied once, without the interpreter's lock.
Arrays that nobody writes to and that hold the same share it at the other end. What both ends have already,
such as the rigs, travels as its number.
"""

from __future__ import annotations

import hashlib
import io
import pickle
import struct
from typing import TYPE_CHECKING, Any, BinaryIO, cast

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

_COUNT = struct.Struct("<Q")
_SIZE = struct.Struct("<Q?")
"""Bytes of a piece, and whether it may not be written to."""
_NUMBER = struct.Struct("<I")
"""In which piece a buffer is."""


def send(file: BinaryIO, value: object, shared: Sequence[object] = ()) -> None:
    """Write an object.

    Args:
        file: Where to.
        value: Anything that can be pickled.
        shared: What the other end has too, in the same order.

    Raises:
        OSError: The other end is gone.
    """
    buffers: list[pickle.PickleBuffer] = []
    body = io.BytesIO()
    _Pickler(body, shared, buffers).dump(value)
    pieces, numbers = [body.getbuffer()], list[int]()
    known: dict[bytes, int] = {}
    for raw in (buffer.raw() for buffer in buffers):
        number = len(pieces)
        if raw.readonly:
            number = known.setdefault(hashlib.sha256(raw).digest(), number)
        if number == len(pieces):
            pieces.append(raw)
        numbers.append(number)
    file.write(
        _COUNT.pack(len(pieces)) + b"".join(_SIZE.pack(piece.nbytes, piece.readonly) for piece in pieces)
    )
    file.write(_COUNT.pack(len(numbers)) + b"".join(map(_NUMBER.pack, numbers)))
    for piece in pieces:
        file.write(piece)
    file.flush()


def receive(file: BinaryIO, shared: Sequence[object] = ()) -> Any:
    """Read the next object. For what comes from one of the server's own processes, and from nobody else.

    Args:
        file: Where from.
        shared: What the other end has too, in the same order.

    Raises:
        EOFError: The other end is gone.
    """
    (count,) = _COUNT.unpack(_exactly(file, _COUNT.size))
    head = _exactly(file, count * _SIZE.size)
    (length, _), *sizes = _SIZE.iter_unpack(head)
    (count,) = _COUNT.unpack(_exactly(file, _COUNT.size))
    numbers = [number for (number,) in _NUMBER.iter_unpack(_exactly(file, count * _NUMBER.size))]
    body = file.read(length)
    if len(body) < length:
        raise EOFError("the other process is gone")
    return _Unpickler(io.BytesIO(body), shared, _buffers(file, sizes, numbers)).load()


class _Pickler(pickle.Pickler):
    def __init__(
        self, file: io.BytesIO, shared: Sequence[object], buffers: list[pickle.PickleBuffer]
    ) -> None:
        super().__init__(file, protocol=5, buffer_callback=buffers.append)
        self._numbers = {id(value): number for number, value in enumerate(shared)}

    def persistent_id(self, obj: object) -> int | None:
        return self._numbers.get(id(obj))


class _Unpickler(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, shared: Sequence[object], buffers: Iterable[memoryview]) -> None:
        super().__init__(file, buffers=buffers)
        self._shared = shared

    def persistent_load(self, pid: int) -> object:
        return self._shared[pid]


def _buffers(file: BinaryIO, sizes: list[tuple[int, bool]], numbers: list[int]) -> Iterator[memoryview]:
    """Each buffer, read when its turn comes, so that what takes them over may let go of them one by one."""
    last = {number: place for place, number in enumerate(numbers)}
    kept: dict[int, memoryview] = {}
    for place, number in enumerate(numbers):
        if number not in kept:
            kept[number] = _piece(file, *sizes[number - 1])
        yield kept.pop(number) if last[number] == place else kept[number]


def _piece(file: BinaryIO, size: int, readonly: bool) -> memoryview:
    piece = memoryview(_exactly(file, size))
    return piece.toreadonly() if readonly else piece


def _exactly(file: BinaryIO, size: int) -> bytearray:
    data = bytearray(size)
    if cast("io.BufferedIOBase", file).readinto(data) < size:
        raise EOFError("the other process is gone")
    return data
