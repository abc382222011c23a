"""Reads files that are made worse at random: ``python tests/benchmarks/fuzz_readers.py --files 100000``.

Every file has to be read, and what comes of it to be sound, or to be refused with the reader's own error,
within a second of processor time and 64 MiB of memory. The first that does not is kept and named. With
``--guided`` the files are found by coverage (atheris, where it is installed: requirements/bench.txt).
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import os
import random
import subprocess
import sys
import tempfile
import time
import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fuzz_memory import PeakMemory

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))


if TYPE_CHECKING:
    from collections.abc import Iterator

    from fuzz_kinds import Kind

NAMES = ("midi", "musicxml", "json", "bvh", "show", "recording")
LONGEST_S = 1.0
MAX_BYTES = 64 * 2**20
LARGEST = 64 * 1024
"""Size in bytes of the largest file that is tried with guidance."""
HUNG_S = 30
"""Seconds by the clock after which libFuzzer gives up on one file."""
TOLD_EACH = 10_000
"""After so many files it is told how it stands."""


class FailedError(Exception):
    """A file of which something came that must not."""


@dataclass
class Tally:
    """What came of the files of one kind."""

    read: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    slowest: bytes = b""
    most_bytes: int = 0
    begun_s: float = 0.0

    def __str__(self) -> str:
        files = self.read + self.refused
        rate = files / max(time.perf_counter() - self.begun_s, 1e-9)
        return (
            f"{files:,} files: {self.read:,} read, {self.refused:,} refused; slowest "
            f"{self.slowest_s * 1000:.0f} ms, peak {self.most_bytes / 2**20:.1f} MiB; {rate:.0f} a second"
        )


class Examiner:
    """Reads files of one kind, and keeps the one that fails."""

    def __init__(self, name: str, kind: Kind, folder: Path, seed: int) -> None:
        self.name, self.kind, self.folder, self.seed = name, kind, folder, seed
        folder.mkdir(parents=True, exist_ok=True)
        # Where the process is killed, by a crash of foreign code or for its memory, this is what it read.
        self._now = os.open(folder / f"{name}-{seed}-last.bin", os.O_CREAT | os.O_RDWR)
        # What is loaded at the first use is no file's fault.
        kind.prepare()
        for data in kind.seeds():
            kind.check(data)
        self._memory = PeakMemory()
        self.tally = Tally(begun_s=time.perf_counter())

    def examine(self, data: bytes) -> None:
        """Read a file.

        Raises:
            FailedError: Something came of it that must not.
        """
        os.pwrite(self._now, data, 0)
        os.ftruncate(self._now, len(data))
        self._memory.begin()
        begun = time.process_time()
        try:
            read = self.kind.check(data)
        except Exception as error:
            at = traceback.extract_tb(error.__traceback__)[-1]
            where = f"{Path(at.filename).name}, line {at.lineno}: {at.line}"
            raise FailedError(f"{error!r} in {where}; kept as {self._keep(data, 'failed')}") from error
        took_s = time.process_time() - begun
        used = self._memory.used()
        tally = self.tally
        tally.read, tally.refused = tally.read + read, tally.refused + (not read)
        tally.most_bytes = max(tally.most_bytes, used)
        if took_s > tally.slowest_s:
            tally.slowest_s, tally.slowest = took_s, data
        if took_s > LONGEST_S or used > MAX_BYTES:
            raise FailedError(f"{took_s:.2f} s, {used / 2**20:.0f} MiB; kept as {self._keep(data, 'failed')}")
        if (tally.read + tally.refused) % TOLD_EACH == 0:
            print(f"{self.name}: {tally}", flush=True)

    def end(self) -> None:
        """Keep the slowest file, and say how it went."""
        print(f"{self.name}: {self.tally}; the slowest is {self._keep(self.tally.slowest, 'slowest')}")

    def _keep(self, data: bytes, what: str) -> Path:
        path = self.folder / f"{self.name}-{self.seed}-{what}.bin"
        path.write_bytes(data)
        return path


def mutated(kind: Kind, files: int, seed: int) -> Iterator[bytes]:
    """Yield files, each a seed made worse."""
    rng = random.Random(seed)
    for _ in range(files):
        yield kind.mutate(rng.choice(kind.seeds()), rng)


def fuzz(name: str, files: int, seed: int, folder: Path) -> bool:
    """Read files made worse at random; False at the first that fails."""
    from fuzz_kinds import KINDS

    examiner = Examiner(name, KINDS[name], folder, seed)
    for number, data in enumerate(mutated(KINDS[name], files, seed)):
        try:
            examiner.examine(data)
        except FailedError as error:
            print(f"{name}: file {number} of seed {seed}: {error}")
            return False
    examiner.end()
    return True


def fuzz_guided(name: str, files: int, seed: int, folder: Path) -> None:
    """Read files found by coverage; ends the process, as libFuzzer does, with 0 if none fails."""
    # Foreign, and for Linux only: nothing else here needs it.
    atheris: Any = importlib.import_module("atheris")
    with atheris.instrument_imports(include=["reina"]):
        from fuzz_kinds import KINDS
    kind = KINDS[name]
    examiner = Examiner(name, kind, folder, seed)

    def mutate(data: bytes, largest: int, number: int) -> bytes:
        rng = random.Random(number)
        worse = kind.mutate(data, rng) if rng.random() < 0.5 else atheris.Mutate(data, largest)
        return worse[:largest]

    def examine(data: bytes) -> None:
        examiner.examine(data)
        if examiner.tally.read + examiner.tally.refused == files:
            examiner.end()

    with tempfile.TemporaryDirectory() as corpus:
        for number, data in enumerate(kind.seeds()):
            (Path(corpus) / f"{number}.bin").write_bytes(data)
        options = (f"-runs={files}", f"-seed={seed}", f"-max_len={LARGEST}", f"-timeout={HUNG_S}")
        quiet = ("-print_final_stats=1", "-verbosity=0", f"-artifact_prefix={folder}/{name}-{seed}-")
        atheris.Setup([sys.argv[0], *options, *quiet, corpus], examine, custom_mutator=mutate)
        atheris.Fuzz()


def main() -> int:
    """Do as the command line says; 1 if a file failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kind", choices=(*NAMES, "all"), default="all")
    parser.add_argument("--files", type=int, default=10_000, help="how many of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--guided", action="store_true", help="by coverage, with atheris")
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir()) / "reina-fuzz")
    given = parser.parse_args()
    if given.kind == "all":
        # A process a kind: libFuzzer ends the one that it is in, and peaks of memory are a process's.
        arguments = [sys.executable, __file__, *sys.argv[1:], "--kind"]
        return max([subprocess.run([*arguments, name], check=False).returncode != 0 for name in NAMES])
    if given.guided and importlib.util.find_spec("atheris") is None:
        parser.error("--guided needs atheris, which is not installed: see requirements/bench.txt")
    if given.guided:
        fuzz_guided(given.kind, given.files, given.seed, given.folder)
    return 0 if fuzz(given.kind, given.files, given.seed, given.folder) else 1


if __name__ == "__main__":
    sys.exit(main())
