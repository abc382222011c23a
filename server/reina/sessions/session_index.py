"""Which sessions there are, in memory and in a file: listing them reads no record."""

from __future__ import annotations

import json
import logging
import threading
from bisect import bisect_left, insort
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from typing import TYPE_CHECKING, Any

from reina.sessions.usage import Usage
from reina.system.failure import failure_of
from reina.system.logs import shown_session

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from pathlib import Path

    from reina.sessions.record import SessionRecord

INDEX = "sessions.json"
VERSION = 2
_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Entry:
    """What is kept of a session in the index.

    Attributes:
        id: Its id.
        title: Its title.
        public: Whether it is listed.
        created_at: ISO 8601, UTC.
        modified_ns: When its record was written; another time on disk means that it has to be read again.
        owner: Who made it, where that is known.
        sender: Who sent it; told to nobody.
        size_bytes: How large its files are together.
        seen_s: When it was seen last, seconds since 1970; when it was made where that is not known.
    """

    id: str
    title: str
    public: bool
    created_at: str
    modified_ns: int
    owner: str | None = None
    sender: str = ""
    size_bytes: int = 0
    seen_s: float = 0.0

    @classmethod
    def of(cls, record: SessionRecord, modified_ns: int, size_bytes: int = 0, seen_s: float = 0.0) -> Entry:
        """The entry of a record."""
        made_s = datetime.fromisoformat(record.created_at).timestamp()
        return cls(
            record.id,
            record.title,
            record.public,
            record.created_at,
            modified_ns,
            owner=record.owner,
            sender=record.sender,
            size_bytes=size_bytes,
            seen_s=max(seen_s, made_s),
        )

    @property
    def place(self) -> str:
        """Where it stands in the list: by the time of its creation, then by its id; fit for an address."""
        return f"{self.created_at.removesuffix('+00:00')}Z_{self.id}"


class SessionIndex:
    """All sessions, and those that are listed in the order of their creation. For several threads.

    The file only saves reading every record at the start: it is written then and when the server ends, and
    whatever has changed since, as after a crash, is seen by its time and read again.
    """

    def __init__(self) -> None:
        self._entries: dict[str, Entry] = {}
        self._listed: list[str] = []
        self._changing = threading.Lock()

    def __len__(self) -> int:
        return len(self._entries)

    def fill(
        self,
        folders: Iterable[Path],
        record_file: str,
        read: Callable[[str], SessionRecord],
        file: Path,
        *,
        size_of: Callable[[str], int] = lambda _: 0,
        seen_of: Callable[[str], float] = lambda _: 0.0,
    ) -> None:
        """Take stock.

        Args:
            folders: One a session, by its id.
            record_file: The name of the record in each.
            read: Reads a record by its session's id.
            file: The index as it was kept.
            size_of: Measures a session's files.
            seen_of: Tells when a session was seen last, 0 where that is not known.
        """
        known = _kept(file)
        for folder in folders:
            try:
                modified_ns = (folder / record_file).stat().st_mtime_ns
                entry = known.get(folder.name)
                if entry is None or entry.modified_ns != modified_ns:
                    entry = Entry.of(read(folder.name), modified_ns, size_of(folder.name))
                entry = replace(entry, seen_s=max(entry.seen_s, seen_of(folder.name)))
            except (OSError, ValueError) as error:
                # Damaged from outside; the others are still to be found.
                _log.warning(
                    "session %s cannot be read: %s", shown_session(folder.name), failure_of(error).kind
                )
                continue
            self._entries[entry.id] = entry
        self._listed = sorted(entry.place for entry in self._entries.values() if entry.public)

    def text(self) -> str:
        """What the file holds."""
        with self._changing:
            return json.dumps({"version": VERSION, "sessions": [asdict(e) for e in self._entries.values()]})

    def put(self, entry: Entry) -> None:
        """Take a session in, or what has changed of it."""
        with self._changing:
            self._unlist(entry.id)
            self._entries[entry.id] = entry
            if entry.public:
                insort(self._listed, entry.place)

    def change(self, session_id: str, **fields: Any) -> None:
        """Take in what is counted of a session beside its record; one that is gone stays gone."""
        with self._changing:
            if session_id in self._entries:
                self._entries[session_id] = replace(self._entries[session_id], **fields)

    def entry(self, session_id: str) -> Entry | None:
        """One session's, or None."""
        return self._entries.get(session_id)

    def usage(self, sender: str | None) -> Usage:
        """How many sessions came from a sender, or from all (None), and how large they are."""
        with self._changing:
            sizes = [e.size_bytes for e in self._entries.values() if sender is None or e.sender == sender]
        return Usage(len(sizes), sum(sizes))

    def unseen_since(self, when: float) -> list[str]:
        """The sessions that nobody has seen since a time, seconds since 1970."""
        with self._changing:
            return [entry.id for entry in self._entries.values() if entry.seen_s < when]

    def remove(self, session_id: str) -> None:
        """Forget a session."""
        with self._changing:
            self._unlist(session_id)
            self._entries.pop(session_id, None)

    def page(
        self, limit: int, after: str | None, *, owner: str | None = None
    ) -> tuple[list[Entry], str | None]:
        """Some of the sessions that are listed, or of a person's, the newest first.

        Args:
            limit: How many at most.
            after: What the page before gave; None for the first page.
            owner: Whose, listed or not; None for those that are listed.

        Returns:
            The sessions, and what the next page is asked for with; None when there are no more.
        """
        with self._changing:
            listed = self._listed
            if owner is not None:
                listed = sorted(entry.place for entry in self._entries.values() if entry.owner == owner)
            end = len(listed) if after is None else bisect_left(listed, after)
            start = max(0, end - limit)
            places = listed[start:end][::-1]
            entries = [self._entries[place.partition("_")[2]] for place in places]
        return entries, places[-1] if start and places else None

    def _unlist(self, session_id: str) -> None:
        entry = self._entries.get(session_id)
        if entry is not None and entry.public:
            del self._listed[bisect_left(self._listed, entry.place)]


def _kept(file: Path) -> Mapping[str, Entry]:
    try:
        document: dict[str, Any] = json.loads(file.read_bytes())
        if document["version"] != VERSION:
            return {}
        return {entry["id"]: Entry(**entry) for entry in document["sessions"]}
    except (OSError, ValueError, TypeError, KeyError):
        return {}
