"""Why a note is fingered as it is, in words."""

from collections.abc import Sequence

from reina.instruments.brass.chart import show_valves
from reina.instruments.brass.phrase import Choice, moved

FAST_S = 0.25
"""Onsets nearer than this are called fast."""


def why(
    note: int,
    taken: Sequence[Choice],
    primaries: Sequence[Choice],
    names: Sequence[str],
    onset_s: Sequence[float],
) -> str:
    """Say why a note of a phrase has the fingering it has.

    Args:
        note: Which note of the phrase.
        taken: The choice of each note.
        primaries: What would be usual for each.
        names: What each is called as it is written.
        onset_s: Onset of each.
    """
    choice, usual = taken[note], primaries[note]
    name = names[note]
    if choice.rank == 0:
        return f"{show_valves(choice.valves)}: usual for written {name}"
    neighbours = [index for index in (note - 1, note + 1) if 0 <= index < len(taken)]
    by_usual, by_choice = (
        sum(len(moved(way.valves, taken[index].valves)) for index in neighbours) for way in (usual, choice)
    )
    crossed_by_usual, crossed_by_choice = (
        sum(abs(way.harmonic - taken[index].harmonic) for index in neighbours) for way in (usual, choice)
    )
    gains: list[str] = []
    if by_choice < by_usual:
        gains.append(f"moves {_count(by_choice, 'finger')} and not {by_usual}")
    if crossed_by_choice < crossed_by_usual:
        gains.append(
            f"stays on harmonic {choice.harmonic}, so that the valves alone change the note"
            if not crossed_by_choice
            else "crosses fewer harmonics"
        )
    if not gains and abs(choice.cents) < abs(usual.cents):
        gains.append(f"is {abs(choice.cents):.0f} cents off and not {abs(usual.cents):.0f}")
    apart = min((abs(onset_s[index] - onset_s[note]) for index in neighbours), default=FAST_S)
    speed = f" at {1 / apart:.0f} notes a second" if 0 < apart < FAST_S else ""
    around = ", ".join(dict.fromkeys(names[index] for index in neighbours))
    gain = " and ".join(gains) or "suits the notes further off"
    beside = f" beside {around}" if around else ""
    return f"{show_valves(choice.valves)} in place of {show_valves(usual.valves)}{beside}{speed}: {gain}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number or 'no'} {what}s"
