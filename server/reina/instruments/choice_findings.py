"""Who plays what, as a musician is told of it."""

from collections.abc import Mapping, Sequence

from reina.instruments.cast_reasons import parts_of
from reina.instruments.casting import Casting
from reina.instruments.instrument import Instrument
from reina.instruments.part_names import kinds_of_name
from reina.instruments.part_roles import FAMILY, family_part
from reina.music.findings import Finding, told_finding
from reina.music.score import Part, Score
from reina.music.warnings import ScoreWarning

MOST_NAMED = 5
"""Of more parts the first are named and the others counted."""


def choice_findings(
    score: Score,
    castings: Sequence[Casting],
    instruments: Mapping[str, Instrument],
    reasons: Sequence[Sequence[str]],
) -> tuple[Finding, ...]:
    """Return who plays what of a score, and what of it nobody plays.

    Args:
        score: The score.
        castings: Who plays, each with its part.
        instruments: What can be played, by name.
        reasons: Of each player why it is that part.
    """
    details = tuple(
        ScoreWarning("part_chosen", f"part {casting.part}", "; ".join(because))
        for casting, because in zip(castings, reasons, strict=True)
    )
    lead = castings[0]
    spoken = spoken_name(lead.instrument)
    if not instruments[lead.instrument].plays_drums and all(part.is_drums for part in score.parts):
        return (told_finding("drums_alone", 1, {"instrument": spoken}, player=0, details=details),)
    if len(castings) == 1:
        played = " and ".join(map(_name, _parts(score, [lead])))
        values: dict[str, str | int] = {"instrument": spoken, "part": played}
        instrument = instruments[lead.instrument]
        fitting = [part.index for part in score.parts if _is_for(part, instrument)]
        if not fitting:
            values["side"] = "none"
        elif lead.part in fitting and len(score.parts) > 1:
            values["side"] = "own"
        return (told_finding("part_chosen", 1, values, player=0, details=details),)
    names = _listed([_name(score.parts[casting.part or 0]) for casting in castings])
    told = [told_finding("players_chosen", len(castings), {"parts": names}, details=details)]
    played_parts = {part.index for part in _parts(score, castings)}
    heard = [_name(part) for part in score.parts if part.index not in played_parts]
    if heard:
        told.append(told_finding("parts_heard", len(heard), {"parts": _listed(heard)}))
    return tuple(told)


def spoken_name(instrument: str) -> str:
    """Return an instrument's name as it is said: ``piccolo trumpet``."""
    return instrument.replace("_", " ")


def _is_for(part: Part, instrument: Instrument) -> bool:
    """Whether a part is one for an instrument, by its name or else its program."""
    if instrument.name in FAMILY:
        found = family_part(part)
        return found is not None and found.instrument == instrument.name
    if part.is_drums or instrument.plays_drums:
        return part.is_drums and instrument.plays_drums
    kinds = kinds_of_name(part.name) if part.named else frozenset[str]()
    return instrument.name in kinds or (not kinds and part.program == instrument.program)


def _parts(score: Score, castings: Sequence[Casting]) -> list[Part]:
    return [score.parts[index] for casting in castings for index in parts_of(casting)]


def _name(part: Part) -> str:
    return part.name or f"part {part.index + 1}"


def _listed(names: Sequence[str]) -> str:
    if len(names) <= MOST_NAMED:
        return ", ".join(names)
    return f"{', '.join(names[: MOST_NAMED - 1])} and {len(names) - MOST_NAMED + 1} more"
