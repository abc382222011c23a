"""Who has the tune."""

import numpy as np
from tests.unit.instruments.scores import melody, score_of

from reina.instruments import INSTRUMENTS, who_has_tune

TRUMPET = INSTRUMENTS["trumpet"]
BARS_S = np.arange(0.0, 16.0, 2.0)


def leads(*parts: list[tuple[float, float, int]]) -> list[tuple[float, float, int]]:
    score = score_of(*parts)
    played = [TRUMPET.play(score, part) for part in range(len(parts))]
    return [(one.start_s, one.end_s, one.player) for one in who_has_tune(played, BARS_S, 16.0)]


def line(pitch: int, start_s: float, end_s: float, step_s: float = 0.5) -> list[tuple[float, float, int]]:
    return [(float(t), float(t) + 0.9 * step_s, pitch) for t in np.arange(start_s, end_s, step_s)]


def test_one_player_has_it_always() -> None:
    assert leads(melody([60, 62, 64])) == [(0.0, 16.0, 0)]


def test_the_higher_line_has_it_and_it_goes_over_where_the_lines_cross() -> None:
    one = line(72, 0.0, 8.0) + line(60, 8.0, 16.0)
    other = line(60, 0.0, 8.0) + line(72, 8.0, 16.0)
    assert leads(one, other) == [(0.0, 8.0, 0), (8.0, 16.0, 1)]


def test_who_plays_while_the_other_rests_has_it() -> None:
    assert leads(line(72, 0.0, 8.0), line(60, 8.0, 16.0)) == [(0.0, 8.0, 0), (8.0, 16.0, 1)]


def test_of_equal_height_the_livelier_line_has_it_and_a_short_rest_takes_it_from_nobody() -> None:
    held = [(float(t), float(t) + 1.9, 67) for t in range(0, 16, 2)]
    lively = [note for note in line(67, 0.0, 16.0, 0.25) if not 6.0 <= note[0] < 6.5]
    assert leads(held, lively) == [(0.0, 16.0, 1)]
