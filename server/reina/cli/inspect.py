"""`reina inspect FILE`: parts, tempo, metre, warnings and fingerings of a score, as a table or as JSON."""

import argparse
import json
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from reina.errors import InputError
from reina.instruments import BRASS, Instrument, NoteNames, PartRanking, PlayedPart, describe_score
from reina.music import Score, read_score
from reina.notation import keys_of

DOWN, UP = "●", "○"
REST = "–"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="a MIDI file or a JSON score, gzip'd or zipped too"
    )
    parser.add_argument("--json", action="store_true", help="print JSON and not tables")
    parser.add_argument("--instrument", choices=sorted(BRASS), default="trumpet", help="what plays it")
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
        "--usual-fingerings", action="store_true", help="take no fingering but the usual one of each note"
    )
    parser.add_argument("--sequence", type=int, help="which sequence of a MIDI file of format 2, from 0")


def run(arguments: argparse.Namespace) -> int:
    """Print what is in the file; return 1, with the reason on stderr, if it cannot be read."""
    file: Path = arguments.file
    try:
        score = read_score(file.read_bytes(), filename=file.name, sequence=arguments.sequence)
        instrument = BRASS[arguments.instrument]
        rankings = instrument.rank_parts(score)
        part = rankings[0].part if arguments.part is None else arguments.part
        played = instrument.play(
            score,
            part,
            arguments.transposition,
            written=arguments.written,
            octave_fit=arguments.octave_fit,
            joined_parts=arguments.joined_parts,
            usual_fingerings=arguments.usual_fingerings,
        )
    except (OSError, InputError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        print(f"reina inspect: {file}: {reason}", file=sys.stderr)
        return 1
    if arguments.json:
        text = json.dumps(describe_score(score, instrument, played, rankings=rankings), ensure_ascii=False)
    else:
        text = "\n".join(_lines(score, instrument, rankings, played))
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
    minutes, seconds = divmod(score.duration_s, 60)
    yield f"{score.title}  {int(minutes)}:{seconds:05.2f}  {len(score.notes)} notes"
    if score.sequences > 1:
        yield f"sequence {score.sequence} of {score.sequences}"
    yield from _section("Tempo")
    tempos = [
        (f"{t.onset_beats:g}", f"{t.onset_s:.3f}", f"{t.beats_per_minute:.2f}")
        for t in score.tempo_map.tempos
    ]
    yield from _table(("beat", "second", "beats a minute"), tempos)
    yield from _section("Metre")
    metres = [(f"{s.onset_beats:g}", f"{s.numerator}/{s.denominator}") for s in score.metre_map.signatures]
    yield from _table(("beat", "metre"), metres)
    yield from _section("Key")
    yield from _table(("beat", "sounds", "written", "because"), _keys(score, instrument, played))
    yield from _section(f"Parts, the best for {instrument.name} first")
    yield from _table(
        ("", "part", "name", "program", "notes", "score", "because"), _parts(score, rankings, played)
    )
    warnings = (*score.warnings, *played.warnings)
    yield from _section(f"Warnings: {len(warnings) or 'none'}")
    yield from _table(("kind", "place", "what"), [(w.kind, w.place, w.message) for w in warnings])
    yield from _section(f"Fingerings of {_named(played.parts)}, transposed by {played.transposition}")
    heads = ("bar", "beat", "second", "lasts", "written", "sounds", "valves", "why")
    yield from _table(heads, _fingerings(score, instrument, played))


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


def _named(parts: Sequence[int]) -> str:
    return f"part{'' if len(parts) == 1 else 's'} {', '.join(map(str, parts))}"


def _mark(part: int, played: PlayedPart) -> str:
    if part == played.part:
        return "▶"
    return "+" if part in played.joined_parts else ""


def _fingerings(score: Score, instrument: Instrument, played: PlayedPart) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    line, fingering = played.line, played.fingering
    names = NoteNames(score, [(instrument, played)])
    positions = score.metre_map.positions(score.notes.onset_beats[line.note_index])
    for place, position in enumerate(positions):
        sounding, written = names.of(int(line.note_index[place]))
        pressed = fingering.pressed(place)
        valves = (
            REST
            if pressed is None
            else " ".join(DOWN if valve + 1 in pressed else UP for valve in range(fingering.valves.shape[1]))
        )
        rows.append(
            (
                str(position.bar),
                f"{position.beat:g}",
                f"{line.onset_s[place]:.3f}",
                f"{line.end_s[place] - line.onset_s[place]:.3f}",
                written,
                sounding,
                valves,
                fingering.reasons[place],
            )
        )
    return rows


def _section(title: str) -> tuple[str, str]:
    return ("", title)


def _table(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> Iterable[str]:
    if not rows:
        return
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    for row in (heads, *rows):
        yield "  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
