"""How often one address may ask for what costs much."""

from __future__ import annotations

import pytest

from reina.api.app import create_app
from reina.api.http.rates import KINDS, MOST_A_MINUTE, Counter, Rates
from reina.errors import InputError
from reina.protocol.links import API


def test_a_window_slides() -> None:
    at = [0.0]
    counter = Counter(lambda: at[0])
    for at[0] in (0.0, 10.0, 20.0):
        assert counter.take("frames", "a", 3) == 0
    at[0] = 30.0
    assert counter.take("frames", "a", 3) == 30.0
    assert counter.take("frames", "b", 3) == 0
    assert counter.take("uploads", "a", 3) == 0
    at[0] = 60.0
    assert counter.take("frames", "a", 3) == 0
    assert counter.take("frames", "a", 3) == 10.0


def test_what_is_remembered_is_bounded() -> None:
    counter = Counter(lambda: 0.0)
    for number in range(30_000):
        counter.take("frames", str(number), 1)
    assert counter.take("frames", "29999", 1) > 0
    assert counter.take("frames", "0", 1) == 0


def test_rates_as_they_are_set() -> None:
    assert Rates.named("").most == MOST_A_MINUTE
    assert Rates.named("uploads=5 frames=0").most == MOST_A_MINUTE | {"uploads": 5, "frames": 0}


@pytest.mark.parametrize("text", ["uploads", "uploads=", "uploads=-1", "downloads=5", "uploads=5,frames=1"])
def test_rates_that_cannot_be(text: str) -> None:
    with pytest.raises(InputError, match="REINA_RATES"):
        Rates.named(text)


def test_what_is_counted_is_there() -> None:
    paths = create_app().openapi()["paths"]
    for method, path in KINDS:
        assert method.lower() in paths[f"{API}{path}"]
