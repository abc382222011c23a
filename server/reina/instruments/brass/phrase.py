"""The fingering of a phrase: the cheapest way through the chart.

A note may be fingered in several ways; which one a player takes depends on the notes around it. Each way
costs something by itself (leaving the usual fingering, being out of tune for as long as the note lasts), and
each step from one note to the next costs the fingers moved and the harmonics crossed, the more the faster it
goes: in a trill from F5 to E5 (written), E5 with 1-2 lies on F5's harmonic, so that the middle finger alone
makes the trill. Dynamic programming finds the way through the phrase whose sum is least (Viterbi, IEEE Trans.
Inf. Theory 13, 1967); all weights stand in `Costs`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from reina.instruments.brass.chart import Valves


@dataclass(frozen=True)
class Costs:
    """What weighs how much; 1 is a finger moved in sixteenths at 120 beats a minute.

    Attributes:
        finger: Moving the finger of each valve, valve 1 first; the ring finger is the slowest.
        together: What fingers that move together in one direction cost of what they cost one by one, for each
            finger after the first.
        harmonic: Crossing one harmonic by the lips.
        lips_alone: What a crossing without any valve to help it is multiplied by.
        departure: Leaving the primary fingering.
        rank: For each alternate that is more usual.
        out_of_tune: Being 20 cents off for half a second; it grows with the square.
        reference_s: The interval between onsets at which a movement has its full weight.
        fastest: The most that speed multiplies a movement by.
    """

    finger: tuple[float, ...] = (1.0, 1.0, 1.25, 1.25)
    together: float = 0.85
    harmonic: float = 0.75
    lips_alone: float = 2.0
    departure: float = 1.2
    rank: float = 0.25
    out_of_tune: float = 1.0
    reference_s: float = 0.125
    fastest: float = 4.0

    def speed(self, interval_s: float) -> float:
        """Return what a movement between onsets `interval_s` apart is multiplied by."""
        return min(self.fastest, (self.reference_s / max(interval_s, 1e-3)) ** 2)


@dataclass(frozen=True)
class Choice:
    """One way to finger a note.

    Attributes:
        valves: Which are down.
        rank: 0 for the primary, 1 for the first alternate, and so on.
        harmonic: Which harmonic of the tube sounds.
        cents: How far it is off, after the slide.
    """

    valves: Valves
    rank: int
    harmonic: int
    cents: float


def moved(before: Valves, after: Valves) -> set[int]:
    """Return the valves that change between two fingerings."""
    return set(before) ^ set(after)


def note_cost(choice: Choice, duration_s: float, costs: Costs) -> float:
    """Return what a choice costs by itself."""
    leaving = costs.departure + costs.rank * (choice.rank - 1) if choice.rank else 0.0
    return leaving + costs.out_of_tune * (choice.cents / 20.0) ** 2 * min(1.0, duration_s / 0.5)


def step_cost(before: Choice, after: Choice, interval_s: float, costs: Costs) -> float:
    """Return what going from one note to the next costs."""
    changed = moved(before.valves, after.valves)
    fingers = sum(costs.finger[valve - 1] for valve in changed)
    if changed in (set(before.valves) - set(after.valves), set(after.valves) - set(before.valves)):
        fingers *= costs.together ** max(len(changed) - 1, 0)
    lips = costs.harmonic * abs(after.harmonic - before.harmonic) * (1.0 if changed else costs.lips_alone)
    return costs.speed(interval_s) * (fingers + lips)


def choose(
    choices: Sequence[Sequence[Choice]], onset_s: Sequence[float], end_s: Sequence[float], costs: Costs
) -> list[int]:
    """Return for each note of a phrase which of its choices is taken; of equal ways the more usual.

    Args:
        choices: Of each note, the primary first.
        onset_s: Onset of each note.
        end_s: End of each note.
        costs: What weighs how much.
    """
    if not choices:
        return []
    total = [note_cost(choice, end_s[0] - onset_s[0], costs) for choice in choices[0]]
    came_from: list[list[int]] = []
    for note in range(1, len(choices)):
        interval = onset_s[note] - onset_s[note - 1]
        steps: list[int] = []
        sums: list[float] = []
        for choice in choices[note]:
            ways = [
                sum_before + step_cost(before, choice, interval, costs)
                for before, sum_before in zip(choices[note - 1], total, strict=True)
            ]
            best = min(range(len(ways)), key=ways.__getitem__)
            steps.append(best)
            sums.append(ways[best] + note_cost(choice, end_s[note] - onset_s[note], costs))
        came_from.append(steps)
        total = sums
    taken = [min(range(len(total)), key=total.__getitem__)]
    for steps in reversed(came_from):
        taken.append(steps[taken[-1]])
    return taken[::-1]
