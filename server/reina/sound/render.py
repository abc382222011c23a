"""Renders one plan, segment by segment; a process of its own, started by `reina.sound.renderer`.

    python -m reina.sound.render SOUNDFONT FOLDER NOTES CONTROLS

The plan's arrays (NOTES and CONTROLS rows) come on standard input, and a byte a note, 0 where it is not to be
heard. After them come numbers of segments, one a line, each of which is to be made next, with what follows
it. When standard input is closed, the one who asked is gone, and the process ends. On standard output it
tells, one JSON object a line, ``{"progress": 0.25}``, ``{"segment": 3, "peaks": "..."}`` when that segment
lies in FOLDER, and at the end ``{"done": true}`` or ``{"error": "...", "is_disk_full": false}``.
"""

import json
import os
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import midirenderer
import numpy as np
from numpy.typing import NDArray

from reina.sound.encode import opus, write_flac
from reina.sound.events import CONTROL_DTYPE, NOTE_DTYPE, SoundPlan
from reina.sound.growing_peaks import GrowingPeaks
from reina.sound.hearing import only_heard
from reina.sound.level import EXCERPT, FULL_SCALE, choose_excerpts, levelled, song_gain
from reina.sound.mix import CHANNELS, Mix, Samples
from reina.sound.passages import BLOCK, Passage, cut_into_passages, write_passage
from reina.sound.recording.peaks import peaks_path, write_peaks
from reina.sound.rendered import SONG, segment_path
from reina.sound.segments import OVERLAP, SEGMENT, cut_into_segments
from reina.system.disk_room import is_disk_full
from reina.system.durable import put_in_place, sync
from reina.system.own_process import complain_in_a_line, follow_parent, read_from_parent, yield_to_server

GAINS = (1.0, 1 / 4, 1 / 16, 1 / 64)
"""How loud a passage is rendered: the first at which it does not reach full scale, where the synthesizer
would clip."""
RENDERING = 0.98
"""Share of the work that is passages and segments; the rest is to write the whole."""
ENCODING = 5
"""Work of encoding a sample, in samples that one voice takes to render."""

Tell = Callable[[dict[str, object]], None]


class RenderError(Exception):
    """The synthesizer could not render; the message says why."""


class Wanted:
    """Which segment is to be made next; another thread may change it at any time."""

    def __init__(self) -> None:
        self.segment = 0

    def choose(self, segment: int) -> None:
        """Have a segment made next, and what follows it."""
        self.segment = segment

    def first_of(self, missing: set[int]) -> int:
        """Of the segments that are missing the next one, back at the beginning after the end."""
        following = [segment for segment in missing if segment >= self.segment]
        return min(following or missing)


def render_plan(
    plan: SoundPlan,
    soundfont: bytes,
    song: Path,
    tell: Tell,
    wanted: Wanted,
    heard: NDArray[np.bool_] | None = None,
) -> None:
    """Render a plan; sample 0 of the song is the score's time 0.

    Args:
        plan: What to render.
        soundfont: An SF2 file.
        song: The whole as FLAC (16 bits, stereo, 48 kHz), which appears at the end; its segments and its
            peaks lie beside it.
        tell: Is told `progress`, 0..1, rising, and each `segment` with its `peaks` when it is there.
        wanted: Which segment is to be made next.
        heard: Which notes are, (N,); all when None. The song is as long and as loud as with all of them.

    Raises:
        RenderError: The soundfont is none.
    """
    gain = song_gain([_render_excerpt(plan, passages, soundfont) for passages in choose_excerpts(plan)])
    passages = cut_into_passages(plan)
    segments = cut_into_segments(passages)
    if heard is not None:
        passages = only_heard(passages, heard)
    peaks = GrowingPeaks(segments.frames)
    needed = {number: segments.needed(number, passages) for number in range(segments.count)}
    unrendered = set(range(len(passages)))
    work = [passage.length + len(passage.notes) * BLOCK for passage in passages]
    done, all_work = 0, sum(work) + segments.count * SEGMENT * ENCODING
    with Mix(_partial(song, "mix")) as mix:
        while needed:
            number = wanted.first_of(set(needed))
            index = next((index for index in needed[number] if index in unrendered), None)
            if index is not None:
                mix.add(passages[index].start, _render_passage(plan, passages[index], soundfont))
                unrendered.remove(index)
                done += work[index]
            else:
                del needed[number]
                held = segments.held(number)
                samples = levelled(mix.read(held.start, held.stop), gain)
                _put(segment_path(song, number), opus(samples))
                done += SEGMENT * ENCODING
                told = peaks.measure(number * SEGMENT, samples[OVERLAP : len(samples) - OVERLAP])
                tell({"segment": number, "peaks": told})
            tell({"progress": round(done / all_work * RENDERING, 4)})
        write_peaks(peaks_path(song), peaks.peaks())
        # Where the whole is, everything else is taken for whole too, after a power cut as well.
        for number in range(segments.count):
            sync(segment_path(song, number))
        _put_whole(song, _pieces(mix, segments.frames, gain))
    tell({"progress": 1.0})


def render_whole(plan: SoundPlan, soundfont: bytes, song: Path) -> None:
    """Render a plan as `render_plan` does from its beginning, without segments: the same file, sooner.

    Args:
        plan: What to render.
        soundfont: An SF2 file.
        song: Where to write it.

    Raises:
        RenderError: The soundfont is none.
    """
    gain = song_gain([_render_excerpt(plan, passages, soundfont) for passages in choose_excerpts(plan)])
    passages = cut_into_passages(plan)
    segments = cut_into_segments(passages)
    # Sums of floats depend on their order.
    needed = (index for number in range(segments.count) for index in segments.needed(number, passages))
    with Mix(_partial(song, "mix")) as mix:
        for index in dict.fromkeys(needed):
            mix.add(passages[index].start, _render_passage(plan, passages[index], soundfont))
        _put_whole(song, _pieces(mix, segments.frames, gain))


def _render_excerpt(plan: SoundPlan, passages: list[Passage], soundfont: bytes) -> Samples:
    excerpt = np.zeros((EXCERPT, CHANNELS), dtype=np.float32)
    for passage in passages:
        # The synthesizer goes on where something rings.
        samples = _render_passage(plan, passage, soundfont)[:EXCERPT]
        excerpt[: len(samples)] += samples
    return excerpt


def _render_passage(plan: SoundPlan, passage: Passage, soundfont: bytes) -> Samples:
    """Return a passage as (F, 2) samples with full scale 1, which they may exceed."""
    samples = np.zeros((0, CHANNELS), dtype=np.float32)
    for gain in GAINS:
        try:
            wav = midirenderer.render_wave_from(soundfont, write_passage(plan, passage, gain=gain))
        except (RuntimeError, ValueError) as error:
            raise RenderError(f"the synthesizer refused: {error}") from error
        whole = np.frombuffer(wav, dtype="<i2", offset=wav.index(b"data") + 8)
        clipped = bool(np.any((whole >= FULL_SCALE) | (whole <= -FULL_SCALE)))
        samples = whole.reshape(-1, CHANNELS).astype(np.float32) / np.float32(FULL_SCALE * gain)
        if not clipped:
            break
    return samples


def _pieces(mix: Mix, frames: int, gain: float) -> Iterator[np.ndarray[tuple[int, int], np.dtype[np.int16]]]:
    """The whole as the segments have it, without their overlaps."""
    for first in range(0, frames, SEGMENT):
        mix.forget(first)
        yield levelled(mix.read(first, min(first + SEGMENT, frames)), gain)


def _partial(path: Path, what: str) -> Path:
    """A name for what is not whole yet; the renderer removes what a process that was killed leaves behind."""
    return path.with_name(f"{what}.{os.getpid()}.partial")


def _put(path: Path, data: bytes) -> None:
    partial = _partial(path, path.name)
    partial.write_bytes(data)
    partial.replace(path)


def _put_whole(song: Path, pieces: Iterator[np.ndarray[tuple[int, int], np.dtype[np.int16]]]) -> None:
    partial = _partial(song, song.name)
    write_flac(partial, pieces)
    put_in_place(partial, song)


def main() -> int:
    """Read the plan and render it."""
    soundfont, folder = Path(sys.argv[1]), Path(sys.argv[2])
    note_count, control_count = int(sys.argv[3]), int(sys.argv[4])
    complain_in_a_line()
    yield_to_server()
    plan = SoundPlan(
        notes=np.frombuffer(read_from_parent(note_count * NOTE_DTYPE.itemsize), dtype=NOTE_DTYPE),
        controls=np.frombuffer(read_from_parent(control_count * CONTROL_DTYPE.itemsize), dtype=CONTROL_DTYPE),
        parts=np.zeros(note_count, dtype=np.int32),
    )
    heard = np.frombuffer(read_from_parent(note_count), dtype=np.bool_)
    wanted = Wanted()
    threading.Thread(target=follow_parent, args=(wanted.choose,), daemon=True).start()
    try:
        render_plan(plan, soundfont.read_bytes(), folder / SONG, _tell, wanted, heard)
    except (RenderError, OSError) as error:
        _tell({"error": str(error), "is_disk_full": is_disk_full(error)})
        return 1
    _tell({"done": True})
    return 0


def _tell(message: dict[str, object]) -> None:
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
