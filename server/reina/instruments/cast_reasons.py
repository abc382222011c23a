"""Why a cast is as it is: what each player has, and why nobody plays the rest of the score."""

from collections.abc import Mapping
from dataclasses import dataclass

from reina.instruments.casting import MAX_PLAYERS, Cast, Casting
from reina.instruments.instrument import Instrument
from reina.instruments.part_names import KINDS
from reina.instruments.part_roles import FAMILY, Kind, PartNotes, family_part, role_of
from reina.music.gm import PROGRAM_NAMES
from reina.music.instrument_names import instruments_of_name
from reina.music.score import Part, Score


@dataclass(frozen=True)
class UnplayedPart:
    """A part that nobody plays.

    Attributes:
        part: Its index.
        reason: Why, in words.
    """

    part: int
    reason: str


def casting_reasons(
    score: Score, cast: Cast, instruments: Mapping[str, Instrument]
) -> tuple[tuple[str, ...], ...]:
    """Return for each player of a cast why there is one, in words.

    Args:
        score: The score.
        cast: Who plays what, each casting with its part.
        instruments: What can be played, by name.
    """
    notes_of = PartNotes(score)
    before: list[int] = []
    told: list[tuple[str, ...]] = []
    for casting in cast.castings:
        told.append(tuple(_of_casting(notes_of, casting, before, instruments)))
        before += parts_of(casting)
    return tuple(told)


def unplayed_parts(
    score: Score, cast: Cast, instruments: Mapping[str, Instrument]
) -> tuple[UnplayedPart, ...]:
    """Return the parts that nobody of a cast plays, in the score's order, each with its reason.

    Args:
        score: The score.
        cast: Who plays what, each casting with its part.
        instruments: What can be played, by name.
    """
    notes_of = PartNotes(score)
    played = [part for casting in cast.castings for part in parts_of(casting)]
    full = len(cast.castings) >= MAX_PLAYERS
    return tuple(
        UnplayedPart(part.index, f"{_why_not(notes_of, part, played, instruments, full=full)}; it is heard")
        for part in score.parts
        if part.index not in played
    )


def parts_of(casting: Casting) -> tuple[int, ...]:
    """The parts that a casting plays, its own first; none while it has none."""
    return () if casting.part is None else (casting.part, *casting.joined_parts)


def _of_casting(
    notes_of: PartNotes, casting: Casting, before: list[int], instruments: Mapping[str, Instrument]
) -> list[str]:
    parts = notes_of.score.parts
    if casting.part is None:
        return []
    found = family_part(parts[casting.part])
    reasons: list[str] = []
    if found is None:
        kind = _kind(parts[casting.part])
        played_on = "" if kind == casting.instrument else f", played on the {casting.instrument}"
        reasons.append(f"a part for {kind}{played_on}")
    elif found.instrument == casting.instrument:
        reasons.append(f"{found.reason}: a part for the {found.instrument}")
    else:
        reasons.append(
            f"{found.reason}: a part for the {found.instrument}, played on the {casting.instrument}"
        )
    if before and found is not None:
        reasons.append(role_of(notes_of, casting.part, before, instruments).reason)
    for joined in casting.joined_parts:
        name = parts[joined].name
        role = role_of(notes_of, joined, [casting.part], instruments) if family_part(parts[joined]) else None
        why = f": {role.reason}" if role and role.kind is Kind.CONTINUATION else ""
        reasons.append(f"“{name}” is played together with it{why}")
    return reasons


def _why_not(
    notes_of: PartNotes, part: Part, played: list[int], instruments: Mapping[str, Instrument], *, full: bool
) -> str:
    drums = [instrument for instrument in instruments.values() if instrument.plays_drums]
    if part.is_drums and drums:
        return _why_not_drums(notes_of.score, part, played, drums[0], full=full)
    found = family_part(part)
    if found is None:
        return f"no player for {_kind(part)} yet"
    role = role_of(notes_of, part.index, played, instruments)
    if role.kind is not Kind.OWN:
        return role.reason
    if full:
        return f"{MAX_PLAYERS} play at once at most"
    return f"{found.reason}, {role.reason}; nobody was cast for it"


def _why_not_drums(score: Score, part: Part, played: list[int], drums: Instrument, *, full: bool) -> str:
    if not drums.can_play_of(score, part.index):
        return "the drum kit has none of its sounds"
    if any(score.parts[other].is_drums for other in played):
        return "other drums are played"
    return f"{MAX_PLAYERS} play at once at most" if full else "drums; nobody was cast for them"


def _kind(part: Part) -> str:
    """What a part is for: the instrument that its name speaks of, or else its program's."""
    if part.is_drums:
        return "drums"
    named = instruments_of_name(part.name) if part.named else ()
    if named:
        return next((name for name in named if KINDS.get(name) not in FAMILY), named[0])
    return f"“{part.name}”" if part.program is None else PROGRAM_NAMES[part.program]
