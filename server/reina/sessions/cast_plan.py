"""A cast made ready to play: each casting with its part, its playing and its seat."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reina.instruments import Cast, CastError
from reina.instruments.player import SEATS, SEATS_FOR
from reina.music import NotInScoreError

if TYPE_CHECKING:
    from reina.instruments import Casting, PartRanking, PlayedPart
    from reina.instruments.player import Seat
    from reina.music import Score
    from reina.sessions.stage import Stage


def seats_of(stage: Stage, cast: Cast) -> tuple[Seat, ...]:
    """Each player's seat: as asked for, its instrument's own, or by how many play without one of their own.

    Raises:
        CastError: There is no such seat, two players have one, or two have an instrument with a seat of its
            own: beside one of it the stage has no room for another.
    """
    own = [_own_seat(stage, casting) for casting in cast.castings]
    for number, seat in enumerate(own):
        if seat is not None and seat in own[:number]:
            title = stage.kinds[cast.castings[number].instrument].title
            first = own.index(seat) + 1
            raise CastError(
                f"there is room for one {title} on the stage, and player {first} has it; one player can play "
                "several parts of it (joined_parts)",
                location=f"castings/{number}/instrument",
            )
    together = iter(SEATS_FOR.get(own.count(None), ()))
    chosen = [casting.seat for casting in cast.castings if casting.seat is not None]
    seats: list[Seat] = []
    for number, casting in enumerate(cast.castings):
        place = f"castings/{number}/seat" if len(cast.castings) > 1 else "seat"
        usual = own[number] or next(together)
        name = casting.seat or _free_seat(usual, chosen, seats)
        if name not in SEATS:
            raise CastError(f"there is no seat {name!r}; there are {', '.join(SEATS)}", location=place)
        if SEATS[name] in seats:
            raise CastError(f"the seat {name!r} is taken already", location=place)
        seats.append(SEATS[name])
    return tuple(seats)


def _free_seat(usual: str, chosen: list[str], seats: list[Seat]) -> str:
    """Where somebody stands who has not chosen: the usual seat, or another if somebody else has it."""
    taken = {*chosen, *(seat.name for seat in seats)}
    if usual not in taken:
        return usual
    return next((name for names in SEATS_FOR.values() for name in names if name not in taken), usual)


def _own_seat(stage: Stage, casting: Casting) -> str | None:
    """Where its instrument stands by itself; None where it has no such place, or is not known."""
    instrument = stage.kinds.get(casting.instrument)
    return None if instrument is None else instrument.seat


def complete_cast(
    stage: Stage, score: Score, heard: Score, cast: Cast
) -> tuple[tuple[Casting, ...], tuple[PlayedPart, ...], tuple[tuple[PartRanking, ...], ...]]:
    """Complete each casting by its part, and have the parts played.

    Args:
        stage: Who can play what.
        score: What is played: who plays what is chosen by it.
        heard: The same in the time of its song.
        cast: Who plays; a casting without a part takes the best that is free.

    Returns:
        The castings, each one's part as it is played, and the parts that suit each one's instrument, the best
        first.

    Raises:
        CastError: There is no such player or instrument, or two players have one part.
        NotInScoreError: The score has no such part.
    """
    several = len(cast.castings) > 1
    taken = {casting.part for casting in cast.castings}
    castings: list[Casting] = []
    parts: list[PlayedPart] = []
    rankings: list[tuple[PartRanking, ...]] = []
    for number, casting in enumerate(cast.castings):
        place = f"castings/{number}/" if several else ""
        instrument = stage.instrument(casting, place)
        ranking = instrument.rank_parts(score)
        part = casting.part
        if part is None:
            # The best that nobody plays; where all are played, the best.
            free = (choice.part for choice in ranking if choice.part not in taken)
            part = next(free, ranking[0].part)
            taken.add(part)
        try:
            played = casting.play(instrument, heard, part)
        except NotInScoreError as error:
            raise NotInScoreError(error.detail, location=f"{place}{error.location}") from error
        twice = {other for before in parts for other in before.parts} & set(played.parts)
        if twice:
            raise CastError(f"part {min(twice)} is played by another player already", location=f"{place}part")
        castings.append(replace(casting, part=part, joined_parts=played.joined_parts))
        parts.append(played)
        rankings.append(ranking)
    return tuple(castings), tuple(parts), tuple(rankings)
