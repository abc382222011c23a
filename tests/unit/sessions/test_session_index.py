from __future__ import annotations

from typing import TYPE_CHECKING

from tests.unit.sessions.test_folders import record

from reina.sessions.folders import SessionFolders
from reina.sessions.session_index import INDEX

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

    from reina.sessions.record import SessionRecord


def keep(folders: SessionFolders, *days: int, public: bool = True) -> list[SessionRecord]:
    records = [
        record(title=f"day {day}", public=public, created_at=f"2026-01-{day:02}T00:00:00+00:00")
        for day in days
    ]
    for made in records:
        with folders.staging() as staged:
            folders.adopt(staged, made)
    return records


def titles(folders: SessionFolders, limit: int = 10, after: str | None = None) -> list[str]:
    return [entry.title for entry in folders.index.page(limit, after)[0]]


def test_public_sessions_come_newest_first_page_by_page(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    keep(folders, 3, 1, 5, 2, 4)
    keep(folders, 6, public=False)
    first, following = folders.index.page(2, None)
    assert [entry.title for entry in first] == ["day 5", "day 4"]
    assert following is not None
    assert "+" not in following, "it stands in an address as it is"
    second, last = folders.index.page(2, following)
    assert [entry.title for entry in second] == ["day 3", "day 2"]
    assert folders.index.page(2, last) == (folders.index.page(10, None)[0][-1:], None)
    assert folders.index.page(5, None)[1] is None


def test_a_page_goes_on_where_the_one_before_ended_whatever_happens_meanwhile(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    records = keep(folders, 1, 2, 3, 4)
    _, following = folders.index.page(2, None)
    folders.take_out(records[2].id)
    keep(folders, 9)
    assert titles(folders, after=following) == ["day 2", "day 1"]


def test_sessions_of_one_second_are_all_listed_once(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    keep(folders, *[1] * 7)
    seen: list[str] = []
    after: str | None = None
    while True:
        entries, after = folders.index.page(2, after)
        seen.extend(entry.id for entry in entries)
        if after is None:
            break
    assert len(seen) == len(set(seen)) == 7


def test_what_changes_is_listed_so(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    (kept,) = keep(folders, 1)
    folders.write_record(kept.model_copy(update={"title": "Renamed"}))
    assert titles(folders) == ["Renamed"]
    folders.write_record(kept.model_copy(update={"public": False}))
    assert titles(folders) == []
    folders.write_record(kept)
    folders.take_out(kept.id)
    assert titles(folders) == []


def test_the_kept_index_saves_reading_records_and_is_right_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = SessionFolders(tmp_path)
    one, two, three = keep(before, 1, 2, 3)
    before.write_index()
    # As if the server had crashed after this: the index knows nothing of it.
    before.write_record(two.model_copy(update={"title": "Changed since"}))
    before.take_out(three.id)
    keep(before, 4)
    read: list[str] = []
    original = SessionFolders.record

    def noted(folders: SessionFolders, session_id: str) -> SessionRecord:
        read.append(session_id)
        return original(folders, session_id)

    monkeypatch.setattr(SessionFolders, "record", noted)
    after = SessionFolders(tmp_path)
    assert titles(after) == ["day 4", "Changed since", "day 1"]
    assert one.id not in read
    assert len(read) == 2


def test_a_damaged_index_is_made_anew(tmp_path: Path) -> None:
    keep(SessionFolders(tmp_path), 1)
    for text in ("{", "[]", '{"version": 9}', '{"version": 1, "sessions": [{"id": 3}]}'):
        (tmp_path / INDEX).write_text(text)
        assert titles(SessionFolders(tmp_path)) == ["day 1"]


def test_without_sessions_there_is_no_index(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    (kept,) = keep(folders, 1)
    folders.write_index()
    assert (tmp_path / INDEX).exists()
    folders.take_out(kept.id)
    folders.write_index()
    assert not (tmp_path / INDEX).exists()
