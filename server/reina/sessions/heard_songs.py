"""What the viewers of a session hear instead of its song: a part alone, without it, or higher and lower."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from reina.sessions.song import RenderedSong
    from reina.sound.hearing import Hearing
    from reina.sound.renderer import SongRequest

MOST = 24
"""So many are kept at hand for each session: twelve parts that are practised, each with its rest. One that is
asked for again after that is found in the cache, or rendered anew."""


class HeardSongs:
    """A session's renderings beside the one that everybody hears.

    What was asked for the longest ago goes first.

    Args:
        make: Begins to make one.
    """

    def __init__(self, make: Callable[[Hearing], RenderedSong]) -> None:
        self._make = make
        self._songs: OrderedDict[Hearing, RenderedSong] = OrderedDict()

    def song(self, hearing: Hearing) -> RenderedSong:
        """The song of a hearing, ready or on its way."""
        song = self._songs.get(hearing)
        if song is None or (song.path is not None and not song.path.is_file()):
            song = self._songs[hearing] = self._make(hearing)
        self._songs.move_to_end(hearing)
        while len(self._songs) > MOST:
            _, oldest = self._songs.popitem(last=False)
            oldest.close()
        return song

    def request(self, rendering_id: str) -> tuple[Hearing, SongRequest] | None:
        """The rendering of that name and what it is of, if it is one of them."""
        for hearing, song in self._songs.items():
            if song.request is not None and song.request.rendering_id == rendering_id:
                self._songs.move_to_end(hearing)
                return hearing, song.request
        return None

    @property
    def paths(self) -> set[Path]:
        """Where those that are ready lie."""
        return {song.path for song in self._songs.values() if song.path is not None}

    def close(self) -> None:
        """Give them all up: what is played is another now, or nobody is there any more."""
        for song in self._songs.values():
            song.close()
        self._songs.clear()
