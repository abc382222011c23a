"""The frames of the examples stay as they are, unless a change is meant to be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.golden.example_frames import GOLDEN, TOLERANCE, Example, examples, thinned

if TYPE_CHECKING:
    import httpx


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.name)
def test_the_frames_of_the_examples_are_as_they_were(client: httpx.Client, example: Example) -> None:
    found = thinned(client, example).fields()
    prefix = f"{example.name}: "
    with np.load(GOLDEN) as golden:
        wanted = {name.removeprefix(prefix): golden[name] for name in golden if name.startswith(prefix)}
    assert wanted.keys() <= found.keys()
    for name, values in wanted.items():
        np.testing.assert_allclose(found[name], values, rtol=0, atol=TOLERANCE, err_msg=name)
