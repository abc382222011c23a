"""Whatever a document is like, the reader gives a sound score or its own error.

tests/benchmarks/fuzz_readers.py does more of it.
"""

from __future__ import annotations

import random

from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.music.musicxml.musicxml_mutations import musicxml_seeds, mutate_musicxml
from tests.unit.music.musicxml.musicxml_text import attributes, document, ending, measure, note, words
from tests.unit.music.score_checks import check_score

from reina.music import Limits

LIMITS = Limits(size_bytes=100_000, notes=2_000, bars=500)


def test_the_seeds_are_read() -> None:
    assert all(check_score(seed, limits=LIMITS) for seed in musicxml_seeds())


def test_documents_made_worse_give_a_score_or_the_readers_own_error() -> None:
    rng = random.Random(20_261_130)
    seeds = musicxml_seeds()
    read = sum(
        check_score(mutate_musicxml(rng.choice(seeds), rng), limits=LIMITS) is not None for _ in range(1_500)
    )
    assert 600 < read < 1_500


REPEAT = '<barline location="right"><repeat direction="backward"{}/></barline>'
SIGNS = (
    '<barline location="left"><repeat direction="forward"/></barline>',
    REPEAT.format(""),
    REPEAT.format(' times="3"'),
    REPEAT.format(' after-jump="yes"'),
    ending("1", "start"),
    ending("2", "start"),
    ending("1, 3", "start"),
    ending("1", "stop"),
    words("D.C. al Coda"),
    words("D.S. al Fine"),
    words("To Coda"),
    words("Fine"),
    "<direction><direction-type><segno/></direction-type></direction>",
    "<direction><direction-type><coda/></direction-type></direction>",
)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.lists(st.sampled_from(SIGNS), max_size=3), min_size=1, max_size=12))
def test_any_order_of_signs_comes_to_an_end(signs: list[list[str]]) -> None:
    body = "".join(
        measure((attributes() if number == 0 else "") + note("C4", 4) + "".join(here), number + 1)
        for number, here in enumerate(signs)
    )
    assert check_score(document(body), limits=Limits(bars=20_000, notes=20_000)) is not None
