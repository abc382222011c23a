"""`reina inspect FILE`: parts, tempo, metre, warnings and fingerings of a score, as a table or as JSON."""

import argparse
import json
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from reina.api.settings import Settings
from reina.cli.inspect_cast import asked_cast, cast_document, cast_lines
from reina.cli.score_tables import (
    REST,
    finding_lines,
    fingering_lines,
    heading,
    section,
    table,
    warning_lines,
    words_lines,
)
from reina.cli.usual_cast import further_lines, further_players, usual_castings
from reina.errors import InputError, ReinaError
from reina.instruments import (
    HANDEDNESS,
    INSTRUMENTS,
    Casting,
    Instrument,
    PartRanking,
    PlayedPart,
    describe_score,
    refuse_handedness,
    score_findings,
)
from reina.music import Score, read_score
from reina.notation import keys_of
from reina.sessions.production import Production
from reina.sessions.stage import Stage


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="a MIDI file, MusicXML or a JSON score, gzip'd or zipped too"
    )
    parser.add_argument("--json", action="store_true", help="print JSON and not tables")
    parser.add_argument(
        "--instrument",
        choices=sorted(INSTRUMENTS),
        help="what plays it; by default what plays it when it is opened, and of a score for several players "
        "every player's part is told",
    )
    parser.add_argument("--part", type=int, help="the part to be played; the best one by default")
    parser.add_argument("--transposition", type=int, default=0, metavar="SEMITONES", help="move the part")
    parser.add_argument("--written", action="store_true", help="its pitches are written, not sounding ones")
    parser.add_argument("--octave-fit", action="store_true", help="move it by octaves into range")
    parser.add_argument(
        "--joined-parts",
        type=_indices,
        default=(),
        metavar="PARTS",
        help="further parts that are played together with it, as 1,2",
    )
    parser.add_argument(
        "--cast",
        metavar="CAST",
        help="who plays what: JSON or a file of it, as PUT /sessions/{id}/cast takes it, or auto; "
        "each player's part, fingerings and warnings are printed",
    )
    parser.add_argument(
        "--usual-fingerings", action="store_true", help="take no fingering but the usual one of each note"
    )
    parser.add_argument(
        "--handedness",
        choices=HANDEDNESS,
        default="right",
        help="which hand leads, where it can be played so",
    )
    parser.add_argument("--sequence", type=int, help="which sequence of a MIDI file of format 2, from 0")


def run(arguments: argparse.Namespace) -> int:
    """Print what is in the file; return 1, with the reason on stderr, if it cannot be read."""
    file: Path = arguments.file
    try:
        if arguments.cast is not None:
            text = _of_cast(file, arguments)
            return _print(text)
        score = read_score(file.read_bytes(), filename=file.name, sequence=arguments.sequence)
        said = _said(arguments)
        lead, *others = usual_castings(score, arguments.instrument, arguments.part, alone=bool(said))
        instrument = INSTRUMENTS[lead.instrument]
        refuse_handedness(instrument, arguments.handedness)
        rankings = instrument.rank_parts(score)
        asked = {name: vars(arguments)[name] for name in said if name != "part"}
        played = _played(score, replace(lead, **asked), rankings)
        further = [(INSTRUMENTS[other.instrument], _played(score, other)) for other in others]
    except (OSError, ReinaError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        print(f"reina inspect: {file}: {reason}", file=sys.stderr)
        return 1
    if arguments.json:
        described = describe_score(score, instrument, played, rankings=rankings)
        described["further_players"] = further_players(score, further)
        text = json.dumps(described, ensure_ascii=False)
    else:
        text = "\n".join((*_lines(score, instrument, rankings, played), *further_lines(score, further)))
    return _print(text)


ALONE = {
    "part": None,
    "transposition": 0,
    "written": False,
    "octave_fit": False,
    "joined_parts": (),
    "usual_fingerings": False,
    "handedness": "right",
}
"""What can be asked of one player, and what it is by default."""


def _said(arguments: argparse.Namespace) -> list[str]:
    """What of `ALONE` the command line asks for."""
    return [name for name, value in ALONE.items() if vars(arguments)[name] != value]


def _played(score: Score, casting: Casting, rankings: Sequence[PartRanking] = ()) -> PlayedPart:
    """A casting's part as it is played, the best for its instrument where it names none.

    Raises:
        NotInScoreError: The score has no such part, or parts cannot be joined.
    """
    instrument = INSTRUMENTS[casting.instrument]
    part = casting.part
    if part is None:
        part = (rankings or instrument.rank_parts(score))[0].part
    return casting.play(instrument, score, part)


def _of_cast(file: Path, arguments: argparse.Namespace) -> str:
    """What is printed of a cast.

    Raises:
        InputError: The score or the cast cannot be read, or not be played so.
        OSError: A file cannot be read.
    """
    said = [f"--{name.replace('_', '-')}" for name in _said(arguments)]
    if said:
        raise InputError(f"--cast says what everybody plays; leave out {', '.join(said)}")
    cast = asked_cast(arguments.cast, arguments.sequence)
    score = read_score(file.read_bytes(), filename=file.name, sequence=cast.sequence)
    stage = Stage.load(Settings().rigs_dir)
    production = Production.plan(stage, score, cast=cast)
    if arguments.json:
        return json.dumps(cast_document(production), ensure_ascii=False)
    return "\n".join(cast_lines(production))


def _print(text: str) -> int:
    try:
        print(text, flush=True)
    except BrokenPipeError:
        # Whoever reads has read enough, as `head` does; Python must not fail on flushing what is left.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _indices(text: str) -> tuple[int, ...]:
    try:
        return tuple(int(piece) for piece in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no list of parts as 1,2") from None


def _lines(
    score: Score, instrument: Instrument, rankings: Sequence[PartRanking], played: PlayedPart
) -> Iterable[str]:
    yield from heading(score)
    reasons = next(ranking.reasons for ranking in rankings if ranking.part == played.part)
    yield from finding_lines(score_findings(score, instrument, played, reasons))
    yield from section("Tempo")
    tempos = [
        (f"{t.onset_beats:g}", f"{t.onset_s:.3f}", f"{t.beats_per_minute:.2f}")
        for t in score.tempo_map.tempos
    ]
    yield from table(("beat", "second", "beats a minute"), tempos)
    yield from section("Metre")
    metres = [(f"{s.onset_beats:g}", f"{s.numerator}/{s.denominator}") for s in score.metre_map.signatures]
    yield from table(("beat", "metre"), metres)
    yield from section("Key")
    yield from table(("beat", "sounds", "written", "because"), _keys(score, instrument, played))
    yield from words_lines(score)
    yield from section(f"Parts, the best for {instrument.name} first")
    yield from table(
        ("", "part", "name", "program", "notes", "score", "because"), _parts(score, rankings, played)
    )
    yield from warning_lines((*score.warnings, *played.warnings))
    yield from fingering_lines(score, instrument, played)


_BECAUSE = {
    "file": "the file says so",
    "notes": "found from the notes",
    "none": "the notes are in none",
}


def _keys(score: Score, instrument: Instrument, played: PlayedPart) -> list[tuple[str, ...]]:
    above = instrument.written_pitch(0)
    return [
        (
            f"{key.onset_beats:g}",
            key.transposed(played.transposition).name,
            key.transposed(played.transposition + above).name,
            _BECAUSE[key.source],
        )
        for key in keys_of(score)
    ]


def _parts(score: Score, rankings: Sequence[PartRanking], played: PlayedPart) -> list[tuple[str, ...]]:
    return [
        (
            _mark(ranking.part, played),
            str(ranking.part),
            score.parts[ranking.part].name,
            REST if (program := score.parts[ranking.part].program) is None else str(program),
            str(len(score.note_indices(ranking.part))),
            f"{ranking.score:.1f}",
            "; ".join(ranking.reasons),
        )
        for ranking in rankings
    ]


def _mark(part: int, played: PlayedPart) -> str:
    if part == played.part:
        return "▶"
    return "+" if part in played.joined_parts else ""
