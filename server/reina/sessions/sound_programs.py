"""Which General MIDI sound a part has that does not say."""

from reina.music.score import Part

PIANO, TRUMPET = 0, 56

PROGRAMS_BY_NAME: tuple[tuple[str, int], ...] = (
    ("bass trombone", 57),
    ("bass clarinet", 71),
    ("bass guitar", 33),
    ("double bass", 43),
    ("english horn", 69),
    ("french horn", 60),
    ("glockenspiel", 9),
    ("marimba", 12),
    ("xylophone", 13),
    ("vibraphone", 11),
    ("harpsichord", 6),
    ("flugelhorn", TRUMPET),
    ("fluegelhorn", TRUMPET),
    ("flügelhorn", TRUMPET),
    ("trumpet", TRUMPET),
    ("trompet", TRUMPET),
    ("tromba", TRUMPET),
    ("cornet", TRUMPET),
    ("trombone", 57),
    ("posaune", 57),
    ("euphonium", 58),
    ("tuba", 58),
    ("horn", 60),
    ("brass", 61),
    ("soprano sax", 64),
    ("tenor sax", 66),
    ("baritone sax", 67),
    ("sax", 65),
    ("oboe", 68),
    ("bassoon", 70),
    ("fagott", 70),
    ("clarinet", 71),
    ("klarinette", 71),
    ("piccolo", 72),
    ("flute", 73),
    ("flöte", 73),
    ("recorder", 74),
    ("violin", 40),
    ("viola", 41),
    ("bratsche", 41),
    ("cello", 42),
    ("contrabass", 43),
    ("harp", 46),
    ("timpani", 47),
    ("pauken", 47),
    ("strings", 48),
    ("choir", 52),
    ("voice", 52),
    ("organ", 19),
    ("orgel", 19),
    ("accordion", 21),
    ("guitar", 24),
    ("gitarre", 24),
    ("bass", 32),
    ("piano", PIANO),
)
"""What a part's name holds, and its General MIDI program counted from 0; the first row that fits counts, so
that a longer name stands before those that are part of it."""


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
    name = part.name.casefold()
    return next((program for fragment, program in PROGRAMS_BY_NAME if fragment in name), PIANO)
