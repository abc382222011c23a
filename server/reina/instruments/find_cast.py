"""Who plays a score where nobody has said so: one player, or one on each of several parts."""

from collections.abc import Mapping, Sequence

from reina.instruments.casting import INSTRUMENT, MAX_PLAYERS, PLAYER, Cast, Casting
from reina.instruments.drums.drum_kit import DRUMS as DRUM_KIT
from reina.instruments.drums.drum_kit import spread_parts, struck_notes
from reina.instruments.instrument import Instrument
from reina.instruments.part_names import desk_of_name
from reina.instruments.part_roles import Kind, PartNotes, family_part, role_of
from reina.music.score import Score

DRUMS = DRUM_KIT.name


def find_cast(
    score: Score,
    instruments: Mapping[str, Instrument],
    players: Mapping[str, Sequence[str]],
    *,
    sequence: int | None = None,
    most: int = MAX_PLAYERS,
) -> Cast:
    """Find who plays a score.

    Every part for a trumpet, cornet or flugelhorn that is a line of its own gets a player, the best first,
    `most` at most; of a score with one such part, or none, one trumpeter plays the part that suits best. A
    part of drums gets a drummer, who comes last; drums alone have one alone. A kit that is spread over
    several parts is one drummer's.

    Args:
        score: The score.
        instruments: What can be played, by name.
        players: Of each instrument who can play it, by name, who is asked first before the others.
        sequence: Which sequence of the file the score is, as `Cast` has it.
        most: How many play at once at most.
    """
    drums = _drums_part(score, instruments)
    usual = instruments.get(INSTRUMENT) or next(iter(instruments.values()))
    ranking = [choice.part for choice in usual.rank_parts(score)]
    if drums is not None:
        if all(part.is_drums or not len(score.note_indices(part.index)) for part in score.parts):
            player = (players.get(DRUMS) or (PLAYER,))[0]
            return Cast((_drummer(score, drums, player),), sequence, auto=True)
        most -= 1
    chosen: list[int] = []
    joined: dict[int, list[int]] = {}
    notes_of = PartNotes(score)
    for part in ranking:
        found = family_part(score.parts[part])
        if found is None or found.instrument not in instruments:
            continue
        taken = [*chosen, *(other for others in joined.values() for other in others)]
        role = role_of(notes_of, part, taken, instruments)
        if role.kind is Kind.CONTINUATION and role.other is not None:
            owner = next((lead for lead, others in joined.items() if role.other in others), role.other)
            joined.setdefault(owner, []).append(part)
        elif role.kind is Kind.OWN and len(chosen) < most:
            chosen.append(part)
    castings: list[Casting] = []
    if len(chosen) < 2:
        castings.append(Casting(part=ranking[0], instrument=usual.name))
        chosen = []
    for part in (*chosen[:1], *_in_order(score, chosen[1:])):
        found = family_part(score.parts[part])
        instrument = found.instrument if found else INSTRUMENT
        seen = [casting.player for casting in castings]
        player = min(players.get(instrument) or (PLAYER,), key=seen.count)
        joined_parts = tuple(sorted(joined.get(part, ())))
        castings.append(Casting(part=part, instrument=instrument, player=player, joined_parts=joined_parts))
    if drums is not None:
        seen = [casting.player for casting in castings]
        player = min(players.get(DRUMS) or (PLAYER,), key=seen.count)
        castings.append(_drummer(score, drums, player))
    return Cast(tuple(castings), sequence, auto=True)


def _drums_part(score: Score, instruments: Mapping[str, Instrument]) -> int | None:
    """The part that a drummer plays, if there is one and somebody who can."""
    drums = instruments.get(DRUMS)
    if drums is None:
        return None
    best = drums.rank_parts(score)[0].part
    return best if score.parts[best].is_drums and struck_notes(score, best) else None


def _drummer(score: Score, part: int, player: str) -> Casting:
    joined_parts = spread_parts(score, part)
    return Casting(part=part, instrument=DRUMS, player=player, joined_parts=joined_parts)


def _in_order(score: Score, parts: Sequence[int]) -> list[int]:
    """Parts by their desks where all are numbered, else as the score has them."""
    desks = {part: desk_of_name(score.parts[part].name) for part in parts}
    numbered = all(desk is not None for desk in desks.values())
    return sorted(parts, key=lambda part: ((desks[part] or 0) if numbered else 0, part))
