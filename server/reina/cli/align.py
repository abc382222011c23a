"""`reina align SCORE RECORDING`: where a score is heard in a recording, and how sure that is."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.cli.progress_line import length_of_time
from reina.cli.score_tables import section, table
from reina.errors import InputError
from reina.music import read_score
from reina.sound.alignment import align, write_alignment
from reina.sound.recording.mono import read_mono

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterable

    from reina.music import Score
    from reina.sound.alignment import Alignment, Gap

SURE, FAIRLY_SURE = 0.7, 0.5
"""From which confidence on it is called so."""
SHORTEST_LEAD_IN_S = 0.1
TOLD_S = 0.5
"""What is left out for less is the edge of a cut."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("score", type=Path, metavar="SCORE", help="a MIDI, MusicXML or JSON file")
    parser.add_argument(
        "recording", type=Path, metavar="RECORDING", help="WAV, AIFF, FLAC, MP3, Ogg Vorbis or Opus"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="where to write the map, as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Print what was found; return 1, with the reason on stderr, if a file cannot be used."""
    path: Path = arguments.score
    try:
        score = read_score(path.read_bytes(), filename=path.name)
        path = arguments.recording
        samples, rate = read_mono(path.read_bytes())
        alignment = align(samples, rate, score)
        if arguments.output is not None:
            path = arguments.output
            path.write_bytes(write_alignment(alignment))
    except (OSError, InputError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        print(f"reina align: {path}: {reason}", file=sys.stderr)
        return 1
    for line in lines(score, alignment):
        print(line)
    return 0


def lines(score: Score, alignment: Alignment) -> Iterable[str]:
    """What was found, in plain words."""
    lengths = (
        f"{length_of_time(score.duration_s)} of score, {length_of_time(alignment.song_duration_s)} of sound"
    )
    yield f"{score.title}  {lengths}"
    if not alignment.is_same_music:
        yield "This recording is not the music of this score, or too unlike it; both are left to begin at 0."
        return
    begins_s, ends_s = alignment.begins_s, alignment.ends_s
    yield f"The music begins at {begins_s:.2f} s and ends at {ends_s:.2f} s: {_sure(alignment)}."
    yield from _around(alignment)
    if alignment.transposition:
        size, way = abs(alignment.transposition), "above" if alignment.transposition > 0 else "below"
        yield f"It is played {size} semitone{'s' if size > 1 else ''} {way} the score."
    if abs(alignment.tuning_cents) >= 10:
        way = "above" if alignment.tuning_cents > 0 else "below"
        yield f"It is tuned {abs(alignment.tuning_cents):.0f} cents {way} A = 440 Hz."
    for gap in alignment.gaps:
        yield _gap(score, gap)
    yield from section("Bars")
    yield from table(("bar", "score", "recording", "sure"), _bars(score, alignment))


def _sure(alignment: Alignment) -> str:
    share = f"{100 * alignment.confidence:.0f} %"
    if alignment.confidence >= SURE:
        return f"sure ({share})"
    return f"{'fairly sure' if alignment.confidence >= FAIRLY_SURE else 'not sure'} ({share})"


def _around(alignment: Alignment) -> Iterable[str]:
    if alignment.count_in:
        yield f"{alignment.count_in} beats are counted in before it."
    elif alignment.begins_s > SHORTEST_LEAD_IN_S:
        yield f"Before it are {alignment.begins_s:.2f} s without music of the score."
    if alignment.sounds_after:
        yield "After it there is other sound, such as applause."


def _gap(score: Score, gap: Gap) -> str:
    begin, end = (_bar(score, at_s) for at_s in (gap.score_from_s, gap.score_to_s))
    said: list[str] = []
    if gap.score_length_s > TOLD_S:
        said.append(
            f"the recording leaves out {gap.score_length_s:.1f} s of the score, from bar {begin} to bar {end}"
        )
    if gap.song_length_s > TOLD_S:
        said.append(
            f"{gap.song_length_s:.1f} s of the recording are not in the score, "
            "or are a repeat that it does not have"
        )
    return f"At {gap.song_from_s:.2f} s {'; and '.join(said)}."


def _bar(score: Score, at_s: float) -> int:
    return score.metre_map.position(max(0.0, score.tempo_map.beats(at_s))).bar


def _bars(score: Score, alignment: Alignment) -> list[tuple[str, ...]]:
    bar_lines = score.metre_map.bar_lines(score.duration_beats)
    places = score.tempo_map.seconds(bar_lines)
    heard = alignment.is_heard(places)
    song_s = alignment.song_times(places)
    sure = alignment.confidence_at(places)
    rows: list[tuple[str, ...]] = []
    for index, position in enumerate(score.metre_map.positions(bar_lines)):
        told = (f"{song_s[index]:.2f}", f"{100 * sure[index]:.0f} %") if heard[index] else ("left out", "")
        rows.append((str(position.bar), f"{places[index]:.2f}", *told))
    return rows
