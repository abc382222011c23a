"""Write what follows from the protocol's declarations, or check that what is there still does.

    python -m reina.protocol.generate [--check]

Writes the page's types (web/src/generated/protocol.ts) and frame reader (web/src/generated/frame.ts), the
types of the laboratory (web/src/generated/lab.ts) and of shows (web/src/generated/show.ts), the description
of the stream (docs/protocol.md) and the JSON Schema of shows (docs/show.schema.json). The description of the
HTTP interface is `python -m reina.api.openapi`'s.
"""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.instruments import INSTRUMENTS
from reina.performance import any_player_pattern, schema_parameters
from reina.protocol import alignment, resources, timeline, transport
from reina.protocol.documentation import FROM_SERVER, FROM_VIEWER, documentation
from reina.protocol.lab import LAB_RECEIVED, LAB_SENT
from reina.protocol.reader import constants, frame_reader
from reina.protocol.typescript import interfaces
from reina.protocol.written_part import WrittenPart
from reina.show import EDITS
from reina.show.document import ShowDocument
from reina.show.show_schema import show_schema_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pydantic import BaseModel

ROOT = Path(__file__).parents[3]

SENT: tuple[type[BaseModel], ...] = (
    *FROM_SERVER,
    resources.Session,
    resources.CreatedSession,
    resources.SessionList,
    resources.ControlToken,
    resources.SignIn,
    resources.Score,
    alignment.Alignment,
    resources.Cast,
    resources.InstrumentList,
    resources.StanceList,
    WrittenPart,
    resources.ShowWarnings,
    timeline.ShowCurves,
    timeline.MusicTime,
    timeline.SongPeaks,
    resources.ShowLibrary,
    resources.RigList,
    resources.ShowParameterList,
    resources.ExampleList,
    resources.FileRole,
    resources.Transcription,
    resources.LightMoodList,
    resources.Health,
    resources.Problem,
)
"""What the server sends: every field is there."""

COMMANDS: tuple[type[BaseModel], ...] = (
    transport.Play,
    transport.Pause,
    transport.Seek,
    transport.SetRate,
    transport.SetLoop,
)
RECEIVED: tuple[type[BaseModel], ...] = (
    *FROM_VIEWER,
    *COMMANDS,
    resources.SessionChange,
    resources.Password,
    resources.CastFields,
    alignment.AlignmentCorrections,
)
"""What the server is sent: fields with a default may be left out."""

_HEAD = """\
// Written by `make generate` from server/reina/protocol; do not edit. Field names are the wire's.
"""


def typescript() -> str:
    """The page's half of the protocol."""
    unions = "\n".join(
        f"export type {name} =\n" + "\n".join(f"  | {model.__name__}" for model in members) + "\n"
        for name, members in {
            "ServerMessage": FROM_SERVER,
            "ViewerMessage": FROM_VIEWER,
            "TransportCommand": COMMANDS,
        }.items()
    )
    return "\n".join([_HEAD, constants(), interfaces(SENT, RECEIVED), unions])


def frame_typescript() -> str:
    """What reads frames: for films and the gallery, and not for the first picture."""
    return f"{_HEAD}\n{frame_reader()}"


def show_typescript() -> str:
    """The show's document, its edits, and what comes of them."""
    edits = "export type Edit =\n" + "\n".join(f"  | {model.__name__}" for model in EDITS.values()) + "\n"
    models = interfaces(
        (resources.ShowEdited,), (ShowDocument, timeline.CurvePreview, *EDITS.values()), readonly=True
    )
    return "\n".join([_HEAD, models, edits])


def lab_typescript() -> str:
    """What the laboratory's page asks and is answered."""
    return "\n".join([_HEAD, interfaces(LAB_SENT, LAB_RECEIVED)])


def write_or_check(files: Mapping[Path, str], *, check: bool) -> int:
    """Write files, or with `check` print how they differ from what is there.

    Returns:
        The exit status: 1 when something differs and was to be checked only.
    """
    status = 0
    for path, text in files.items():
        present = path.read_text(encoding="utf-8") if path.exists() else ""
        if present == text:
            continue
        name = path.relative_to(ROOT)
        if check:
            status = 1
            difference = difflib.unified_diff(
                present.splitlines(), text.splitlines(), f"{name}", "as generated", lineterm="", n=1
            )
            sys.stderr.write("\n".join([*difference, f"{name} is stale: run `make generate`.\n"]))
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            sys.stdout.write(f"wrote {name}\n")
    return status


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m reina.protocol.generate", description=__doc__)
    parser.add_argument("--check", action="store_true", help="change nothing; fail when something is stale")
    arguments = parser.parse_args()
    files = {
        ROOT / "web/src/generated/protocol.ts": typescript(),
        ROOT / "web/src/generated/frame.ts": frame_typescript(),
        ROOT / "web/src/generated/show.ts": show_typescript(),
        ROOT / "web/src/generated/lab.ts": lab_typescript(),
        ROOT / "docs/protocol.md": documentation(),
        ROOT / "docs/show.schema.json": show_schema_text(
            schema_parameters(INSTRUMENTS.values()), any_player_pattern
        ),
    }
    return write_or_check(files, check=arguments.check)


if __name__ == "__main__":
    raise SystemExit(main())
