"""Lights to choose are tracks that the show takes."""

import pytest

from reina.show import Show, TimeMap, with_edits
from reina.stage import LIGHT_MOODS, LightMood, stage_registry


@pytest.mark.parametrize("mood", LIGHT_MOODS, ids=lambda mood: mood.name)
def test_each_is_taken_by_a_show(mood: LightMood) -> None:
    registry = stage_registry()
    edits = [
        {"edit": "put_track", "track": {"parameter": path, "keyframes": [{"time": 0, "value": value}]}}
        for path, value in mood.values.items()
    ]
    show = with_edits(Show(()), edits, registry, TimeMap.steady())
    assert {track.parameter for track in show.tracks} == set(mood.values)
    for path, value in mood.values.items():
        parameter = registry[path]
        if isinstance(value, float):
            assert parameter.minimum is None or value >= parameter.minimum
            assert parameter.maximum is None or value <= parameter.maximum


def test_names_and_titles_are_told_apart() -> None:
    assert (
        len({mood.name for mood in LIGHT_MOODS})
        == len({mood.title for mood in LIGHT_MOODS})
        == len(LIGHT_MOODS)
    )
