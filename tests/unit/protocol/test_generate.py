from __future__ import annotations

import re
from typing import TYPE_CHECKING

from reina.protocol import generate
from reina.protocol.documentation import FROM_SERVER, FROM_VIEWER, documentation

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def test_what_is_committed_is_what_is_generated() -> None:
    committed = {
        generate.ROOT / "web/src/generated/protocol.ts": generate.typescript(),
        generate.ROOT / "web/src/generated/frame.ts": generate.frame_typescript(),
        generate.ROOT / "docs/protocol.md": documentation(),
    }
    assert generate.write_or_check(committed, check=True) == 0


def test_a_stale_file_is_told_and_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(generate, "ROOT", tmp_path)
    path = tmp_path / "protocol.ts"
    path.write_text("export const VERSION = 1\n")
    assert generate.write_or_check({path: "export const VERSION = 2\n"}, check=True) == 1
    assert path.read_text() == "export const VERSION = 1\n"
    told = capsys.readouterr().err
    assert "-export const VERSION = 1" in told
    assert "protocol.ts is stale: run `make generate`" in told


def test_writing_makes_it_fresh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generate, "ROOT", tmp_path)
    path = tmp_path / "new" / "protocol.ts"
    assert generate.write_or_check({path: "text\n"}, check=False) == 0
    assert path.read_text() == "text\n"
    assert generate.write_or_check({path: "text\n"}, check=True) == 0


def test_every_message_is_documented_and_typed() -> None:
    text, types = documentation(), generate.typescript()
    for model in (*FROM_SERVER, *FROM_VIEWER):
        assert f"export interface {model.__name__} " in types
        for field in model.model_fields:
            assert f"| `{field}` |" in text


def test_choices_of_the_same_words_have_them_in_one_order() -> None:
    # typing takes Literals of the same words for equal and keeps the first that it meets: in another order,
    # what is generated would depend on what was imported before.
    orders: dict[frozenset[str], set[str]] = {}
    for path in (generate.ROOT / "server").rglob("*.py"):
        for words in re.findall(r"\bLiteral\[([^\]]+)\]", path.read_text(encoding="utf-8")):
            listed = [word.strip() for word in words.split(",") if word.strip()]
            orders.setdefault(frozenset(listed), set()).add(", ".join(listed))
    assert len(orders) > 20
    assert [order for order in orders.values() if len(order) > 1] == []
