"""Names of pitches for people."""

_STEPS = ("C", "C♯", "D", "E♭", "E", "F", "F♯", "G", "A♭", "A", "B♭", "B")


def pitch_name(number: int) -> str:
    """Return the name of a MIDI number, ``"B♭4"``; C4 is 60."""
    octave, step = divmod(number, 12)
    return f"{_STEPS[step]}{octave - 1}"
