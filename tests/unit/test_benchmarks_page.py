"""docs/benchmarks.md is made of docs/benchmarks.json, and says who is ahead."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests.benchmarks import table
from tests.benchmarks.table import Bound, Row

ROOT = Path(__file__).parents[2]
FASTER = Row("Streams", "a frame", "µs", 5.0, "viser", "1.1", 600.0)
SLOWER = Row("Files", "MIDI | notes", "ms", 20.0, "symusic", "0.6", 0.5, notes="C++")
ALIKE = Row("Files", "BVH", "ms", 8.0, "bvhio", "1.2", 8.2)
FULLER = Row("Files", "targets reached", "%", 50.0, "ikpy", "3.4", 100.0, better="higher")
AWAY = Row("Streams", "a frame", "µs", 5.0, "Nchan", "", None, notes="not installed")
ROWS = [FASTER, SLOWER, ALIKE, FULLER, AWAY]
BOUNDS = [Bound("bench_x.py", "a frame", 12.5, 12.0, "µs"), Bound("bench_x.py", "a read", 0.1, 1.0, "s")]


def page(*, short: bool = False) -> str:
    return table.markdown(table.dump(ROWS, BOUNDS, {"processor": "A, 2 cores"}, short=short))


def test_page_follows_from_its_json() -> None:
    document = json.loads((ROOT / "docs/benchmarks.json").read_text(encoding="utf-8"))
    assert document["rows"]
    assert (ROOT / "docs/benchmarks.md").read_text(encoding="utf-8") == table.markdown(document)


def test_json_says_what_the_rows_say() -> None:
    document = json.loads((ROOT / "docs/benchmarks.json").read_text(encoding="utf-8"))
    assert document["rows"] == [Row.from_json(row).to_json() for row in document["rows"]]


@pytest.mark.parametrize(
    ("row", "ahead", "ratio"),
    [(FASTER, "reina", 120), (SLOWER, "peer", 0.025), (ALIKE, "equal", 1.025), (FULLER, "peer", 0.5)],
)
def test_ratio_and_who_is_ahead(row: Row, ahead: str, ratio: float) -> None:
    assert row.ahead == ahead
    assert row.ratio == pytest.approx(ratio)


def test_peer_that_is_ahead_is_told_so() -> None:
    assert "| a frame | µs | 5 | viser 1.1 | 600 | Reina ahead, 120 times |  |" in page()
    assert "| MIDI \\| notes | ms | 20 | symusic 0.6 | 0.5 | **symusic ahead, 40 times** | C++ |" in page()
    assert "Reina is ahead in 1 of 5 rows, equal in 1; a peer is ahead in 2 (symusic, ikpy)." in page()


def test_peer_that_is_not_there_is_told_so() -> None:
    assert "| a frame | µs | 5 | Nchan | – | no figure | not installed |" in page()
    assert "Not measured: Nchan (not installed)." in page()


def test_bounds_stand_in_a_part_of_their_own() -> None:
    lines = page().partition("## Beside their bounds")[2]
    assert "| bench_x.py | a frame | 12.5 µs | 12 µs, **missed** |" in lines
    assert "| bench_x.py | a read | 0.1 s | 1 s |" in lines


def test_form_is_told() -> None:
    assert "`make bench SHORT=1` measured" in page(short=True)
    assert "`make bench` measured" in page()


def test_what_is_collected_comes_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "collected"
    monkeypatch.setenv(table.COLLECTED, str(file))
    table.tell(*ROWS)
    table.collect("bounds", {**vars(BOUNDS[0])})
    assert table.collected(file.read_text(encoding="utf-8")) == (ROWS, BOUNDS[:1])
    assert "symusic ahead, 40 times" in capsys.readouterr().out


def test_best_of_turns_is_taken() -> None:
    turns: list[str] = []
    figures = iter([3, 7, 2, 9])

    def run(name: str) -> int:
        turns.append(name)
        return next(figures)

    best = table.alternate(2, lambda: run("reina"), lambda: run("peer"), key=float)
    assert best == [2, 7]
    assert turns == ["reina", "peer", "reina", "peer"]
