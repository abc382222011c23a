"""Shows made worse at random are whole shows that can be written and evaluated, or refused in few words."""

import random

from tests.unit.show.show_mutations import check_show, mutate_show, seeds


def test_every_seed_is_read() -> None:
    assert all(check_show(seed) for seed in seeds())


def test_mutated_shows_are_read_or_refused() -> None:
    rng = random.Random(20_261_130)
    assert 60 < sum(check_show(mutate_show(rng.choice(seeds()), rng)) for _ in range(600)) < 500
