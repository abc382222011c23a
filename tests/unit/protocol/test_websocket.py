from __future__ import annotations

import pytest
from websockets.frames import Frame, Opcode
from websockets.streams import StreamReader

from reina.protocol.websocket import binary_frame, message_of, text_frame


def parsed(data: bytes) -> Frame:
    """The frame as a client's library reads it, who expects it to have no mask."""
    reader = StreamReader()
    reader.feed_data(data)
    parsing = Frame.parse(reader.read_exact, mask=False, max_size=1 << 20)
    with pytest.raises(StopIteration) as done:
        next(parsing)
    assert reader.at_eof is not None
    reader.feed_eof()
    at_end = reader.at_eof()
    with pytest.raises(StopIteration) as ended:
        next(at_end)
    assert ended.value.value is True, "nothing is left over"
    frame = done.value.value
    assert isinstance(frame, Frame)
    return frame


@pytest.mark.parametrize("length", [0, 1, 125, 126, 127, 65_535, 65_536, 200_000])
def test_what_is_made_is_a_whole_frame_of_its_length(length: int) -> None:
    data = bytes(number % 251 for number in range(length))
    frame = parsed(binary_frame(data))
    assert (frame.opcode, frame.fin, bytes(frame.data)) == (Opcode.BINARY, True, data)
    assert message_of(binary_frame(data)) == data


@pytest.mark.parametrize("text", ["", "x" * 125, "é" * 63, "x" * 65_535, "音" * 30_000])
def test_texts_are_as_long_as_their_bytes(text: str) -> None:
    frame = parsed(text_frame(text))
    assert (frame.opcode, frame.fin, bytes(frame.data)) == (Opcode.TEXT, True, text.encode())
    assert message_of(text_frame(text)) == text
