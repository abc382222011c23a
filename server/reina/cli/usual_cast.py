"""Who `reina inspect` takes to play a score where nobody says so: the same as when it is opened."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from reina.cli.score_tables import fingering_lines, named_parts, section, warning_lines
from reina.instruments import (
    INSTRUMENTS,
    Casting,
    Instrument,
    PlayedPart,
    describe_notes,
    describe_warnings,
    find_cast,
)
from reina.music import Score


def usual_castings(
    score: Score, instrument: str | None, part: int | None, *, alone: bool
) -> tuple[Casting, ...]:
    """Return who plays: what is asked for, else the cast that is found for the score.

    Args:
        score: The score.
        instrument: What plays it, where that was asked for.
        part: The part, where that was asked for; who plays it when the score is opened plays it.
        alone: Whether anything is asked of one player, so that nobody else is told of.
    """
    if instrument is not None:
        return (Casting(part=part, instrument=instrument),)
    on_stage = {name: one for name, one in INSTRUMENTS.items() if one.rig}
    found = find_cast(score, on_stage, {}).castings
    if part is None:
        return found[:1] if alone else found
    for casting in found:
        if casting.part == part:
            return (casting,)
    usual = Casting(part=part)
    if not 0 <= part < len(score.parts) or not score.parts[part].is_drums:
        return (usual,)
    for_drums = (name for name, one in on_stage.items() if one.plays_drums)
    return (replace(usual, instrument=next(for_drums, usual.instrument)),)


def further_players(score: Score, players: Sequence[tuple[Instrument, PlayedPart]]) -> list[dict[str, Any]]:
    """What those after the first play, as JSON has it."""
    return [
        {
            "instrument": instrument.name,
            "part": played.part,
            "joined_parts": list(played.joined_parts),
            "transposition": played.transposition,
            "played_notes": [
                note for part in played.parts for note in describe_notes(score, instrument, played, part)
            ],
            "warnings": describe_warnings(played.warnings),
        }
        for instrument, played in players
    ]


def further_lines(score: Score, players: Sequence[tuple[Instrument, PlayedPart]]) -> Iterable[str]:
    """The same as tables."""
    for number, (instrument, played) in enumerate(players, start=2):
        yield from section(f"Player {number}: {instrument.title}, {named_parts(played.parts)}")
        yield from warning_lines(played.warnings)
        yield from fingering_lines(score, instrument, played)
