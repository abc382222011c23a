"""Renders one plan on a cluster's worker, from which the files go back to the server."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from reina.sound.font import SoundError, soundfont_id
from reina.sound.provide_soundfont import own_soundfont
from reina.sound.recording.peaks import peaks_path
from reina.sound.render import RenderError, Wanted, render_plan
from reina.sound.rendered import SONG, RenderedFiles, segment_path
from reina.system.cluster import AwayError

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from reina.sound.events import SoundPlan


def render_files(
    plan: SoundPlan, heard: NDArray[np.bool_], soundfont: str, tell: Callable[[float], None]
) -> RenderedFiles:
    """Render a plan.

    Args:
        plan: What to render.
        heard: Which notes are, (N,).
        soundfont: The `soundfont_id` of whoever asks.
        tell: Called with the share that is done, 0..1.

    Raises:
        AwayError: This machine has another soundfont, or none.
        SoundError: It cannot be rendered.
    """
    try:
        font = own_soundfont()
    except SoundError as error:
        raise AwayError(f"a worker has no soundfont: {error}") from error
    if soundfont_id(font) != soundfont:
        raise AwayError(f"a worker has another soundfont, {font}; every machine needs the same")

    def progress(message: dict[str, object]) -> None:
        if isinstance(share := message.get("progress"), float):
            tell(share)

    with tempfile.TemporaryDirectory(prefix="reina-song-") as folder:
        song = Path(folder) / SONG
        try:
            render_plan(plan, font.read_bytes(), song, progress, Wanted(), heard)
        except RenderError as error:
            raise SoundError(f"the score could not be rendered: {error}") from error
        count = sum(1 for _ in song.parent.glob("*.opus"))
        segments = tuple(segment_path(song, number).read_bytes() for number in range(count))
        return RenderedFiles(song.read_bytes(), peaks_path(song).read_bytes(), segments)
