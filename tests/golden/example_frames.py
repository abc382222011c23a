"""The frames of every example with both players: a guard for changes that are not meant to be seen.

    python -m tests.golden.example_frames renew      writes tests/golden/example_frames.npz anew
    python -m tests.golden.example_frames COMMIT     compares every byte with another commit, on this machine

The first thins them out, and is compared within 1e-5, since the last bit differs between processors
(tests/integration/test_example_frames.py). The second starts that commit's server beside this one's, from a
work tree of its own, and compares whole examples from byte 24 of each frame on.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from tests.integration.scores import song
from tests.integration.server import serve, upload

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

    from numpy.typing import NDArray

REPOSITORY = Path(__file__).parents[2]
GOLDEN = Path(__file__).with_name("example_frames.npz")
PLAYERS = ("trumpeter", "soloist")
HEADER_BYTES = 24
FPS = 60
INSTANTS = 6
"""At how many places an example is looked at."""
FRAMES = 3
"""How many frames each time."""
TOLERANCE = 1e-5


@dataclass(frozen=True)
class Example:
    """A score, with its own show where it has one, and who plays it."""

    score: Path
    show: Path | None
    player: str

    @property
    def name(self) -> str:
        return f"{self.score.name}, {self.player}"


def examples() -> list[Example]:
    """Every score of examples/ with each player."""
    scores = sorted((REPOSITORY / "examples" / "scores").glob("*.*"))
    shows = {path.stem: path for path in (REPOSITORY / "examples" / "shows").glob("*.json")}
    return [Example(score, shows.get(score.stem), player) for score in scores for player in PLAYERS]


@dataclass(frozen=True)
class Frames:
    """Frames of an example: where its fields are, and (F, frame_size) bytes."""

    manifest: dict[str, Any]
    raw: NDArray[np.uint8]

    def fields(self) -> dict[str, NDArray[np.float32]]:
        """Each field by its name, (F, its length) float32."""
        fields: dict[str, NDArray[np.float32]] = {}
        for skeleton in self.manifest["skeletons"]:
            count = 4 * len(skeleton["joints"])
            fields[f"{skeleton['name']}: rotations"] = self._floats(skeleton["offset"], count)
            fields[f"{skeleton['name']}: root"] = self._floats(skeleton["root_offset"], 3)
        for parameter in self.manifest["parameters"]:
            fields[parameter["path"]] = self._floats(parameter["offset"], parameter["length"])
        return fields

    def _floats(self, offset: int, count: int) -> NDArray[np.float32]:
        return np.ascontiguousarray(self.raw[:, offset : offset + 4 * count]).view("<f4")


@contextmanager
def session_of(client: httpx.Client, example: Example) -> Generator[dict[str, Any]]:
    """A session of an example, with a song of its own so that nothing is rendered."""
    files: dict[str, Any] = {"song": ("silence.wav", song())}
    if example.show:
        files["show"] = (example.show.name, example.show.read_bytes())
    made = upload(client, example.score.read_bytes(), example.score.name, player=example.player, **files)
    try:
        yield made.body
    finally:
        made.change("DELETE")


def fetch(client: httpx.Client, session: str, spans: list[tuple[float, float]]) -> Frames:
    """The frames of some spans of a session, one after the other."""
    path = f"/api/v1/sessions/{session}"
    manifest = client.get(f"{path}/manifest").raise_for_status().json()
    content = b"".join(
        client.get(f"{path}/frames", params={"start_s": start_s, "end_s": end_s, "fps": FPS})
        .raise_for_status()
        .content
        for start_s, end_s in spans
    )
    return Frames(manifest, np.frombuffer(content, np.uint8).reshape(-1, manifest["frame_size"]))


def thinned(client: httpx.Client, example: Example) -> Frames:
    """A few frames at some places of an example."""
    with session_of(client, example) as session:
        last = int(session["duration_s"] * FPS) - FRAMES
        first = [last * instant // (INSTANTS - 1) for instant in range(INSTANTS)]
        spans = [(frame / FPS, (frame + FRAMES) / FPS) for frame in first]
        return fetch(client, session["id"], spans)


def whole(client: httpx.Client, example: Example) -> Frames:
    """Every frame of an example."""
    with session_of(client, example) as session:
        return fetch(client, session["id"], [(0.0, session["duration_s"])])


@contextmanager
def a_client(source: Path) -> Generator[httpx.Client]:
    """A client of a server that runs from a work tree."""
    with (
        tempfile.TemporaryDirectory() as data_dir,
        serve(Path(data_dir), "--no-page", source=source) as running,
        httpx.Client(base_url=running.address, timeout=120.0) as client,
    ):
        yield client


def renew() -> None:
    """Write the golden file."""
    with a_client(REPOSITORY) as client:
        fields = {
            f"{example.name}: {name}": values
            for example in examples()
            for name, values in thinned(client, example).fields().items()
        }
    np.savez_compressed(GOLDEN, **fields)  # pyright: ignore[reportArgumentType] - names are keywords here


@contextmanager
def work_tree(commit: str) -> Generator[Path]:
    """A work tree of another commit."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tree"
        git = ["git", "-C", str(REPOSITORY), "worktree"]
        subprocess.run([*git, "add", "--detach", "--quiet", str(path), commit], check=True)
        try:
            yield path
        finally:
            subprocess.run([*git, "remove", "--force", str(path)], check=True)


def differences(commit: str) -> Iterator[str]:
    """Yield what differs in each example between a commit and the present work tree."""
    with work_tree(commit) as path, a_client(path) as before, a_client(REPOSITORY) as now:
        for example in examples():
            one, other = whole(before, example), whole(now, example)
            if one.raw.shape != other.raw.shape:
                yield f"{example.name}: {one.raw.shape} and {other.raw.shape} frames and bytes"
            elif not np.array_equal(one.raw[:, HEADER_BYTES:], other.raw[:, HEADER_BYTES:]):
                rows = np.flatnonzero((one.raw != other.raw)[:, HEADER_BYTES:].any(axis=1))
                values = zip(one.fields().values(), other.fields().items(), strict=True)
                names = [name for was, (name, now_is) in values if not np.array_equal(was, now_is)]
                yield f"{example.name}: {len(rows)} frames from {rows[0]} on differ in {', '.join(names)}"
            print(f"{example.name}: {len(other.raw)} frames compared", file=sys.stderr)


def main(argument: str) -> int:
    """Renew the golden file, or compare with a commit; 1 if anything differs."""
    if argument == "renew":
        renew()
        return 0
    found = list(differences(argument))
    print("\n".join(found) or f"every byte is the same as at {argument}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
