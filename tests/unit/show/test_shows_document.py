"""What docs/shows.md shows is run, and what it lists is complete."""

import json
import re
from pathlib import Path

import pytest

from reina.curves.extrapolation import EXTRAPOLATIONS
from reina.curves.interpolation import BUILT_IN
from reina.curves.value_types import VALUE_TYPES
from reina.show import Show
from reina.show.event_response import EventResponse, NoteFilter
from reina.stage import stage_registry

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "docs" / "shows.md").read_text(encoding="utf-8")


def _blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, flags=re.DOTALL)


@pytest.mark.parametrize("source", _blocks("python"))
def test_the_python_runs(source: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    exec(compile(source, "docs/shows.md", "exec"), {"__name__": "shown"})


def test_the_document_is_a_show() -> None:
    (source,) = _blocks("json")
    show = Show.from_document(json.loads(source), stage_registry())
    assert show.unknown_parameters == ()
    assert len(show.tracks) == 2


def test_every_word_of_a_show_is_explained() -> None:
    quoted = set(re.findall(r"`([a-z0-9_]+)`", TEXT))
    families = {name.rsplit("_in_out", 1)[0].removesuffix("_in").removesuffix("_out") for name in BUILT_IN}
    plain = {"step", "linear", "cubic_bezier", "cubic_spline", "automatic", "clamped"}
    assert plain | (families - {"cubic_bezier"}) <= quoted | {"quad"}
    assert set(EXTRAPOLATIONS) | set(EventResponse.model_fields) | set(NoteFilter.model_fields) <= quoted
    assert all(re.search(rf"^\|.*\b{name}\b", TEXT, flags=re.MULTILINE) for name in VALUE_TYPES)
