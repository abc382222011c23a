"""Which shot a passage gets: what suits its music, else what was not just seen."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from reina.stage.music_form import Passage


@dataclass(frozen=True)
class Piece:
    """What a passage is compared with: the means of all passages, weighted by their bars."""

    notes_per_second: float
    loudness: float
    height: float

    @classmethod
    def of(cls, all_passages: Sequence[Passage]) -> "Piece":
        """The means of passages, one at least."""
        bars = sum(passage.end_bar - passage.start_bar for passage in all_passages)

        def mean(value: Callable[[Passage], float]) -> float:
            return sum(value(p) * (p.end_bar - p.start_bar) for p in all_passages) / bars

        return cls(mean(lambda p: p.notes_per_second), mean(lambda p: p.loudness), mean(lambda p: p.height))


@dataclass(frozen=True)
class Choice:
    """When some shots are chosen.

    Attributes:
        shots: Names of `SHOTS`, the one that is liked best first.
        name: What the marker says.
        suits: Whether a passage of a piece asks for it.
    """

    shots: tuple[str, ...]
    name: str
    suits: Callable[[Passage, Piece], bool]


def _rests(passage: Passage, _: Piece) -> bool:
    return passage.sounding < 0.25


def _is_fast(passage: Passage, piece: Piece) -> bool:
    return passage.notes_per_second >= max(3.5, 1.15 * piece.notes_per_second)


def _is_loud(passage: Passage, piece: Piece) -> bool:
    return passage.loudness >= piece.loudness + 0.05


def _is_high(passage: Passage, piece: Piece) -> bool:
    return passage.height >= piece.height + 2.5


def _is_soft(passage: Passage, piece: Piece) -> bool:
    return passage.loudness <= piece.loudness - 0.05


@dataclass(frozen=True)
class Direction:
    """The shots that there are, and when each is taken.

    Attributes:
        widest: What a piece begins and ends with.
        choices: The first that suits is taken; of its shots the first that was not just seen: its best one
            may come again after one other, the rest after two.
        in_turn: What is shown where nothing asks for something else.
    """

    widest: str
    choices: tuple[Choice, ...]
    in_turn: tuple[str, ...]


ALONE = Direction(
    widest="room",
    choices=(
        Choice(("room", "figure"), "Rest", _rests),
        Choice(("valves", "fingers", "bell"), "Fast", _is_fast),
        Choice(("low", "bell", "shoulder"), "Loud", _is_loud),
        Choice(("portrait", "bell", "crane"), "High", _is_high),
        Choice(("profile", "shoulder", "crane"), "Soft", _is_soft),
    ),
    in_turn=("figure", "portrait", "shoulder", "fingers", "profile", "crane", "low", "bell"),
)
"""One player: names of `shots.SHOTS`."""

TOGETHER = Direction(
    widest="everybody",
    choices=(
        Choice(("everybody", "everybody from above"), "Rest", _rests),
        Choice(("hands", "bell", "everybody from the left"), "Fast", _is_fast),
        Choice(("everybody from below", "low", "everybody from the left"), "Loud", _is_loud),
        Choice(("portrait", "everybody from above", "crane"), "High", _is_high),
        Choice(("figure", "everybody from the left", "portrait"), "Soft", _is_soft),
    ),
    in_turn=(
        "figure",
        "everybody from the left",
        "portrait",
        "everybody",
        "bell",
        "everybody from above",
        "crane",
        "everybody from below",
        "hands",
    ),
)
"""A cast: everybody, or the player who has the tune; names that `cast_shots.cast_shot` knows."""

WITH_DRUMS = replace(
    TOGETHER,
    choices=(
        Choice(("hi-hat side", "kit from above", "everybody"), "Rest", _rests),
        Choice(("hands", "hi-hat side", "bell"), "Fast", _is_fast),
        *TOGETHER.choices[2:],
    ),
    in_turn=(
        "figure",
        "everybody from the left",
        "portrait",
        "hi-hat side",
        "everybody",
        "bell",
        "kit from above",
        "everybody from above",
        "ride side",
    ),
)
"""Others before a drummer, who has the rests and some of the rest."""


def choose_shots(found: Sequence[Passage], piece: Piece, direction: Direction) -> list[tuple[str, str]]:
    """Choose each passage's shot, and say why. It begins, and ends, with the widest.

    Args:
        found: The passages.
        piece: What they are compared with.
        direction: The shots that there are.
    """
    chosen: list[tuple[str, str]] = []
    turn = 0
    for index, passage in enumerate(found):
        recent = [shot for shot, _ in chosen[-2:]]
        name = "Beginning" if index == 0 else "End" if index == len(found) - 1 else f"Phrase {passage.phrase}"
        choice = next((choice for choice in direction.choices if choice.suits(passage, piece)), None)
        if choice is not None:
            name = choice.name if index > 0 else name
        liked = [direction.widest] if index in (0, len(found) - 1) and len(found) > 1 else []
        liked += choice.shots if choice is not None and index > 0 else ()
        shot = next((s for s in liked if s not in recent or (s == liked[0] and s != recent[-1])), None)
        while shot is None:
            shot = direction.in_turn[turn % len(direction.in_turn)]
            shot = None if shot in recent else shot
            turn += 1
        chosen.append((shot, name))
    return chosen
