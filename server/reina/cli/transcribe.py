"""`reina transcribe RECORDING`: the notes of a recording of one line, as MIDI."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.cli.progress_line import length_of_time
from reina.errors import InputError
from reina.instruments import INSTRUMENTS
from reina.music.midi.writer import write_midi
from reina.sound.recording.mono import read_mono
from reina.sound.transcription.transcribe import Line, line_of, transcribe

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterable

    from reina.music import Score


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "recording", type=Path, metavar="RECORDING", help="WAV, FLAC, MP3, Ogg Vorbis or Opus; one line alone"
    )
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="the MIDI file; beside the recording by default"
    )
    parser.add_argument(
        "--instrument",
        choices=list(INSTRUMENTS),
        metavar="NAME",
        help=f"what plays, which bounds what is looked for: {', '.join(INSTRUMENTS)}",
    )
    parser.add_argument("--title", help="what the score is called; as the file by default")


def run(arguments: argparse.Namespace) -> int:
    """Write the notes; return 1, with the reason on stderr, if none are found or a file cannot be used."""
    path: Path = arguments.recording
    output: Path = arguments.output or path.with_suffix(".mid")
    line = Line() if arguments.instrument is None else line_of(INSTRUMENTS[arguments.instrument])
    try:
        samples, rate = read_mono(path.read_bytes())
        score = transcribe(samples, rate, line, title=arguments.title or path.stem)
        path = output
        path.write_bytes(write_midi(score))
    except (OSError, InputError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        print(f"reina transcribe: {path}: {reason}", file=sys.stderr)
        return 1
    for told in lines(score, output):
        print(told)
    return 0


def lines(score: Score, output: Path) -> Iterable[str]:
    """What was found, in plain words."""
    tempos = score.tempo_map.seconds_per_beat
    yield f"{score.title}  {len(score.notes)} notes in {length_of_time(score.duration_s)}"
    if score.warnings:
        yield from (f"{warning.message}." for warning in score.warnings)
    else:
        slowest, fastest = 60 / float(tempos.max()), 60 / float(tempos.min())
        yield f"Tempo {slowest:.0f} to {fastest:.0f} beats a minute."
    yield f"Written to {output}."
