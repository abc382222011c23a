"""`reina bake` without processes: what is found, what is sent out, what is put together."""

from __future__ import annotations

import functools
import json
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import duet, scale

from reina.cli import bake, main
from reina.cli.bake import bakery, library, work
from reina.cli.bake.bakery import PARTS, Bakery, Recipe, Summary
from reina.cli.bake.library import BY_REVISION, MANIFEST, Library, scores_in
from reina.cli.bake.work import OtherReinaError, ScoreOrder
from reina.errors import InputError
from reina.system import cluster

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from reina.system.cluster import Work

FONT = "a font"
SOUND = b"a sound"
QUIET = "nothing of it is a pitch"


def here(
    _client: object, another: Callable[[], Work[Any] | None], _tell: object
) -> Iterator[tuple[Work[Any], Any, BaseException | None]]:
    """`cluster.outcomes` in this very process, the last that was sent out first."""
    under_way: list[Work[Any]] = []
    while True:
        while (piece := another()) is not None and len(under_way) < 4:
            under_way.append(piece)
        if piece is not None:
            under_way.append(piece)
        if not under_way:
            return
        piece = under_way.pop()
        try:
            result, error = piece.function(*piece.arguments), None
        except InputError as raised:
            result, error = None, raised
        yield piece, result, error


@pytest.fixture(autouse=True)
def without_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bakery, "outcomes", here)

    def song(order: ScoreOrder, soundfont: str) -> bytes:
        assert soundfont == FONT
        if order.filename == "quiet.mid":
            raise InputError(QUIET)
        return SOUND

    monkeypatch.setattr(work, "song", song)


def baked(folder: Path, output: Path, parts: frozenset[str] = frozenset(PARTS), **recipe: Any) -> Summary:
    """Bake all of a folder; returns what became of it."""
    output.mkdir(exist_ok=True)
    shelf = Library(output)
    asked: dict[str, Any] = {"instrument": None, "maker": work.maker(), "soundfont": FONT, **recipe}
    baker = Bakery(shelf, Recipe(parts, **asked), folder, unheard)
    with shelf.open():
        baker.bake(None, baker.missing(scores_in(folder, output)))  # pyright: ignore[reportArgumentType]
    return baker.summary


def unheard(_summary: Summary, _said: str) -> None:
    """Nobody watches."""


def manifest(folder: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((folder / MANIFEST).read_bytes())
    return document


def files(folder: Path) -> dict[str, bytes]:
    found = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


@pytest.fixture
def scores(tmp_path: Path) -> Path:
    folder = tmp_path / "scores"
    folder.mkdir()
    (folder / "duet.mid").write_bytes(duet())
    return folder


def test_a_long_score_that_is_made_in_stretches_is_the_same(
    scores: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert baked(scores, tmp_path / "at once").made == ["duet.mid"]
    for module in (work, bakery):
        monkeypatch.setattr(module, "AT_ONCE", 2)
    assert baked(scores, tmp_path / "in stretches").made == ["duet.mid"]
    one, other = (files(tmp_path / name) for name in ("at once", "in stretches"))
    assert one == other
    assert manifest(tmp_path / "in stretches" / "duet.mid")["parts"]["blocks"]["count"] > 2 * 2
    assert {"duet.mid/player-1.bvh", "duet.mid/song.flac", "duet.mid/show.json"} <= one.keys()


def test_parts_are_added_to_those_that_are_there(scores: Path, tmp_path: Path) -> None:
    output = tmp_path / "out"
    baked(scores, output, frozenset({"show", "blocks"}))
    before = (output / "duet.mid" / "show.json").stat()
    assert baked(scores, output, frozenset({"sound"})).made == ["duet.mid"]
    kept = (output / "duet.mid" / "show.json").stat()
    assert (kept.st_ino, kept.st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    parts = manifest(output / "duet.mid")["parts"]
    assert list(parts) == ["show", "blocks", "sound"]
    assert (output / "duet.mid" / "song.flac").read_bytes() == SOUND
    assert (output / BY_REVISION / parts["blocks"]["revision"] / "0").is_file()
    assert baked(scores, output, frozenset({"blocks", "sound"})).there == ["duet.mid"]


@pytest.mark.parametrize("other", [{"maker": None}, {"instrument": "cornet"}])
def test_what_another_reina_or_instrument_made_is_made_anew(
    scores: Path, tmp_path: Path, other: dict[str, str | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = frozenset({"show"})
    baked(scores, tmp_path / "out", parts)
    if "maker" in other:
        monkeypatch.setattr(work, "maker", lambda: "another")
        other = {"maker": "another"}
    assert baked(scores, tmp_path / "out", parts, **other).made == ["duet.mid"]
    assert baked(scores, tmp_path / "out", parts, **other).there == ["duet.mid"]


def test_another_soundfont_asks_for_the_sound_alone(scores: Path, tmp_path: Path) -> None:
    baked(scores, tmp_path / "out", frozenset({"show", "sound"}))
    document = manifest(tmp_path / "out" / "duet.mid")
    document["parts"]["sound"]["soundfont"] = "an older font"
    (tmp_path / "out" / "duet.mid" / MANIFEST).write_text(json.dumps(document))
    assert baked(scores, tmp_path / "out", frozenset({"show"})).there == ["duet.mid"]
    assert baked(scores, tmp_path / "out", frozenset({"sound"})).made == ["duet.mid"]


def test_a_score_without_sound_has_all_else_and_says_why(scores: Path, tmp_path: Path) -> None:
    (scores / "quiet.mid").write_bytes(scale(3))
    parts = frozenset({"show", "sound"})
    assert baked(scores, tmp_path / "out", parts).made == ["quiet.mid", "duet.mid"]
    assert manifest(tmp_path / "out" / "quiet.mid")["parts"]["sound"] == {
        "files": {},
        "soundfont": FONT,
        "silent": QUIET,
    }
    assert baked(scores, tmp_path / "out", parts).there == ["duet.mid", "quiet.mid"]


def test_a_score_that_fails_leaves_what_was_there_before(scores: Path, tmp_path: Path) -> None:
    baked(scores, tmp_path / "out", frozenset({"show"}))
    before = files(tmp_path / "out")
    (scores / "duet.mid").write_bytes(b"MThdbroken")
    failed = baked(scores, tmp_path / "out", frozenset({"show"})).failed
    assert list(failed) == ["duet.mid"]
    assert "byte" in failed["duet.mid"]
    assert files(tmp_path / "out") == before


def test_a_worker_with_another_reina_ends_the_bake(scores: Path, tmp_path: Path) -> None:
    with pytest.raises(OtherReinaError, match="every machine needs the same"):
        baked(scores, tmp_path / "out", frozenset({"show"}), maker="another")
    assert not list((tmp_path / "out").rglob(MANIFEST))


def test_what_a_bake_that_was_killed_left_is_removed(scores: Path, tmp_path: Path) -> None:
    left = tmp_path / "out" / library.STAGING / "half"
    left.mkdir(parents=True)
    (left / "show.json").write_text("{")
    gone = tmp_path / "out" / BY_REVISION / "0123456789abcdef"
    gone.parent.mkdir()
    gone.symlink_to("../gone.mid/blocks/0123456789abcdef")
    baked(scores, tmp_path / "out", frozenset({"show"}))
    assert not left.exists()
    assert not gone.is_symlink()


def test_scores_are_found_and_nothing_else(tmp_path: Path) -> None:
    examples = Path(__file__).parents[3] / "examples"
    folder = tmp_path / "in"
    for path in (folder / "deep" / "er", folder / ".hidden", folder / "baked" / "march.mid"):
        path.mkdir(parents=True)
    for name in ("a.mid", "deep/er/b.MID", ".hidden/c.mid", ".d.mid", "baked/e.mid", "f.musicxml", "g.gz"):
        (folder / name).write_bytes(b"")
    shutil.copy(examples / "scores" / "ode-to-joy.json", folder / "ode.json")
    shutil.copy(next((examples / "shows").glob("*.json")), folder / "show.json")
    (folder / "package.json").write_text('{"name": "else"}')
    (folder / "note.txt").write_text("MThd")
    (folder / "photo.png").write_bytes(b"\x89PNG")
    found = [path.relative_to(folder).as_posix() for path in scores_in(folder, folder / "baked")]
    assert found == ["a.mid", "deep/er/b.MID", "f.musicxml", "g.gz", "note.txt", "ode.json"]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["nowhere"], "nowhere is no folder"),
        (["empty"], "there are no scores in empty: MIDI, MusicXML or JSON"),
    ],
)
def test_what_cannot_be_baked_is_told_in_a_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    told: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    assert main(["bake", *arguments]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"reina bake: {told}")
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize("option", [[], ["--scheduler", "tcp://127.0.0.1:9"]])
def test_without_dask_it_says_what_to_install(
    scores: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], option: list[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["bake", str(scores), "--only", "show", *option]) == 1
    assert capsys.readouterr().err == (
        "reina bake: this needs dask.distributed, which is not installed: "
        'pip install "reina[cluster]"; in a checkout `make cluster`\n'
    )


@pytest.mark.parametrize("wrong", [["--only", "film"], ["--workers", "0"], ["--instrument", "kazoo"]])
def test_wrong_options_are_refused(scores: Path, wrong: list[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["bake", str(scores), *wrong])
    assert ended.value.code == 2


def test_a_scheduler_that_does_not_answer_is_told(
    scores: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    soon = functools.partial(cluster.cluster_at, within_s=0.1)
    monkeypatch.setattr(bake, "cluster_at", soon)
    assert main(["bake", str(scores), "--only", "show", "--scheduler", "tcp://127.0.0.1:9"]) == 1
    assert "reina bake: no Dask scheduler answers at tcp://127.0.0.1:9" in capsys.readouterr().err
