"""Which General MIDI sound a part has that does not say."""

from reina.music.instrument_names import program_of_name
from reina.music.score import Part

PIANO = 0


def default_program(part: Part, player_program: int | None = None) -> int:
    """Return a part's program; without one: its player's instrument's, else by its name, else a piano.

    Args:
        part: The part; its own program, where it has one, is returned.
        player_program: That of the instrument on which a player plays it, if one does.
    """
    if part.program is not None:
        return part.program
    if part.is_drums:
        return 0
    if player_program is not None:
        return player_program
    program = program_of_name(part.name)
    return PIANO if program is None else program
