"""Which General MIDI sound a part has that does not say."""

from reina.music.instrument_names import program_of_name
from reina.music.score import Part

PIANO, TRUMPET = 0, 56


def default_program(part: Part, *, is_trumpet: bool = False) -> int:
    """Return a part's program; without one: a trumpet if chosen as one, else by its name, else a piano.

    Args:
        part: The part; its own program, where it has one, is returned.
        is_trumpet: Whether the trumpeter plays it.
    """
    if part.program is not None:
        return part.program
    if part.is_drums:
        return 0
    if is_trumpet:
        return TRUMPET
    program = program_of_name(part.name)
    return PIANO if program is None else program
