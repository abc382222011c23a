from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from reina.sessions.folders import SessionFolders
from reina.sessions.record import (
    SESSION_ID,
    SessionRecord,
    created_now,
    new_id,
)
from reina.system.tokens import hash_token, new_token, token_matches

if TYPE_CHECKING:
    from pathlib import Path


def record(**changes: object) -> SessionRecord:
    fields: dict[str, object] = {
        "id": new_id(),
        "title": "Taps",
        "public": False,
        "created_at": created_now(),
        "token_sha256": hash_token("secret"),
        "instrument": "trumpet",
        "part": 0,
        "transposition": 0,
        "score_filename": "taps.mid",
        "song": None,
    }
    return SessionRecord.model_validate(fields | changes)


def files(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_a_session_is_there_as_a_whole_or_not_at_all(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    kept = record()
    with folders.staging() as staged:
        (staged / "score").write_bytes(b"MThd")
        assert kept.id not in folders
        folders.adopt(staged, kept)
    assert kept.id in folders
    assert folders.record(kept.id) == kept
    assert files(tmp_path) == [f"sessions/{kept.id}/score", f"sessions/{kept.id}/session.json"]


def test_what_was_not_wanted_is_removed(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    with pytest.raises(RuntimeError, match="refused"), folders.staging() as staged:  # noqa: PT012
        (staged / "score").write_bytes(b"MThd")
        raise RuntimeError("refused")
    assert files(tmp_path) == []


def test_what_a_crash_left_half_made_is_removed_at_the_next_start(tmp_path: Path) -> None:
    SessionFolders(tmp_path)
    (tmp_path / "staging" / "half").mkdir()
    (tmp_path / "staging" / "half" / "score").write_bytes(b"MThd")
    SessionFolders(tmp_path)
    assert files(tmp_path) == []


def test_what_is_taken_out_is_gone_at_once_and_swept_up_at_the_next_start(tmp_path: Path) -> None:
    folders = SessionFolders(tmp_path)
    kept = record()
    with folders.staging() as staged:
        folders.adopt(staged, kept)
    folders.take_out(kept.id)
    assert kept.id not in folders
    SessionFolders(tmp_path)
    assert files(tmp_path) == []


@pytest.mark.parametrize("session_id", ["..", "../sessions", "", ".", "a/b", "x" * 22 + "\n", "x" * 21])
def test_no_id_leads_out_of_the_folder(tmp_path: Path, session_id: str) -> None:
    assert session_id not in SessionFolders(tmp_path)


def test_ids_and_tokens_are_random_and_tokens_are_not_kept() -> None:
    ids = {new_id() for _ in range(100)}
    assert len(ids) == 100
    assert all(SESSION_ID.fullmatch(session_id) for session_id in ids)
    token = new_token()
    kept = record(token_sha256=hash_token(token))
    assert token not in kept.model_dump_json()
    assert token_matches(kept.token_sha256, token)
    assert not token_matches(kept.token_sha256, new_token())
