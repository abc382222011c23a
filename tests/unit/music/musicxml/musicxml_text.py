"""MusicXML documents as notation programs write them, made of few words."""

from __future__ import annotations

import io
import zipfile

DOCTYPE = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<!DOCTYPE score-partwise PUBLIC '
    '"-//Recordare//DTD MusicXML 4.0 Partwise//EN" "http://www.musicxml.org/dtds/partwise.dtd">\n'
)
TYPES = {4.0: "whole", 2.0: "half", 1.0: "quarter", 0.5: "eighth", 0.25: "16th"}
DIVISIONS = 12
"""What `note` counts a quarter note in."""

B_FLAT = "<transpose><diatonic>-1</diatonic><chromatic>-2</chromatic></transpose>"


def note(name: str, beats: float = 1.0, *, inner: str = "", before: str = "", attributes: str = "") -> str:
    """A note by its name (``F#4``, ``Bb3``; ``r`` is a rest), `before` its pitch and `inner` after."""
    length = f"<duration>{beats * DIVISIONS:g}</duration>"
    if "<grace" in before:
        length = ""
    kind = f"<type>{TYPES[beats]}</type>" if beats in TYPES else ""
    what = "<rest/>" if name == "r" else pitch(name)
    voice = "" if "<voice>" in inner else "<voice>1</voice>"
    return f"<note {attributes}>{before}{what}{length}{_ties(inner)}{voice}{kind}{inner}</note>\n"


def pitch(name: str) -> str:
    """``<pitch>`` of a name."""
    step, octave = name[0], name[-1]
    alter = {"#": 1, "b": -1}.get(name[1:-1])
    altered = "" if alter is None else f"<alter>{alter}</alter>"
    return f"<pitch><step>{step}</step>{altered}<octave>{octave}</octave></pitch>"


def _ties(inner: str) -> str:
    return "".join(f'<tie type="{kind}"/>' for kind in ("stop", "start") if f'<tied type="{kind}"/>' in inner)


def notations(inner: str) -> str:
    return f"<notations>{inner}</notations>"


def articulations(*names: str) -> str:
    return notations(f"<articulations>{''.join(f'<{name}/>' for name in names)}</articulations>")


def tied(*kinds: str) -> str:
    return notations("".join(f'<tied type="{kind}"/>' for kind in kinds))


def slur(*kinds: str, number: int = 1) -> str:
    return notations("".join(f'<slur type="{kind}" number="{number}"/>' for kind in kinds))


def lyric(syllabic: str, text: str, more: str = "", verse: int = 1) -> str:
    return f'<lyric number="{verse}"><syllabic>{syllabic}</syllabic><text>{text}</text>{more}</lyric>'


def attributes(metre: str = "4/4", fifths: int = 0, extra: str = "", divisions: int = DIVISIONS) -> str:
    beats, kind = metre.split("/")
    return (
        f"<attributes><divisions>{divisions}</divisions><key><fifths>{fifths}</fifths></key>"
        f"<time><beats>{beats}</beats><beat-type>{kind}</beat-type></time>{extra}</attributes>\n"
    )


def tempo(bpm: float) -> str:
    return direction(
        f"<metronome><beat-unit>quarter</beat-unit><per-minute>{bpm:g}</per-minute></metronome>",
        f'<sound tempo="{bpm:g}"/>',
    )


def direction(kind: str, sound: str = "") -> str:
    return f"<direction><direction-type>{kind}</direction-type>{sound}</direction>\n"


def dynamic(name: str) -> str:
    return direction(f"<dynamics><{name}/></dynamics>")


def words(text: str, sound: str = "") -> str:
    return direction(f"<words>{text}</words>", sound)


def wedge(kind: str) -> str:
    return direction(f'<wedge type="{kind}" number="1"/>')


def barline(inner: str, location: str = "right") -> str:
    return f'<barline location="{location}">{inner}</barline>\n'


REPEAT_BEGINS = barline('<repeat direction="forward"/>', "left")
REPEAT_ENDS = barline('<repeat direction="backward"/>')


def ending(number: str, kind: str, extra: str = "") -> str:
    location = "left" if kind == "start" else "right"
    return barline(f'<ending number="{number}" type="{kind}"/>{extra}', location)


def measure(inner: str, number: int | str = 1, more: str = "") -> str:
    return f'<measure number="{number}" {more}>\n{inner}</measure>\n'


def measures(*inner: str) -> str:
    return "".join(measure(one, number) for number, one in enumerate(inner, 1))


def listed(
    identity: str = "P1", name: str = "Trumpet", program: int | None = 57, inner: str | None = None
) -> str:
    """An entry in the list of parts; `program` is counted from 1, as MusicXML does."""
    midi = f'<midi-instrument id="{identity}-I1"><midi-channel>1</midi-channel>' + (
        f"<midi-program>{program}</midi-program></midi-instrument>"
    )
    if inner is None:
        inner = f'<score-instrument id="{identity}-I1"><instrument-name>{name}</instrument-name>'
        inner += "</score-instrument>"
        inner += midi if program is not None else ""
    return f'<score-part id="{identity}"><part-name>{name}</part-name>{inner}</score-part>\n'


def document(*parts: str, parts_listed: str | None = None, head: str = "") -> bytes:
    """A partwise document of parts, each the text of its measures."""
    if parts_listed is None:
        parts_listed = "".join(listed(f"P{n}") for n, _ in enumerate(parts, 1))
    body = "".join(f'<part id="P{n}">\n{part}</part>\n' for n, part in enumerate(parts, 1))
    return (
        f'{DOCTYPE}<score-partwise version="4.0">\n{head}<part-list>{parts_listed}</part-list>\n{body}'
        "</score-partwise>\n"
    ).encode()


def compressed(data: bytes, path: str = "score.xml") -> bytes:
    """A document as .mxl."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", "application/vnd.recordare.musicxml")
        archive.writestr(
            "META-INF/container.xml",
            '<?xml version="1.0" encoding="UTF-8"?><container><rootfiles>'
            f'<rootfile full-path="{path}" media-type="application/vnd.recordare.musicxml+xml"/>'
            "</rootfiles></container>",
        )
        archive.writestr(path, data)
    return stream.getvalue()
