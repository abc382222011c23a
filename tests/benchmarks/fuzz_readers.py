"""Read mutated score files until told to stop: ``python tests/benchmarks/fuzz_reader.py [FILES] [SEED]``.

Every file has to give a sound score or `ScoreError`, within a second and without growing memory; the first
that does not is written beside this script's working directory and named.
"""

import sys
import time
import tracemalloc
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.unit.music.mutations import mutated
from tests.unit.music.test_fuzz import check

LONGEST_S = 1.0
MOST_BYTES = 64 * 2**20


def main(files: int, seed: int) -> int:
    """Read `files` mutated files; return 1 at the first that fails."""
    read = refused = 0
    slowest = 0.0
    begin = time.perf_counter()
    tracemalloc.start()
    for number, data in enumerate(mutated(files, seed)):
        started = time.process_time()
        try:
            score = check(data)
        except Exception as error:
            failed = Path(f"fuzz-{seed}-{number}.bin")
            failed.write_bytes(data)
            print(f"file {number} of seed {seed}: {error!r}; kept as {failed}")
            return 1
        took = time.process_time() - started
        slowest = max(slowest, took)
        read, refused = (read + 1, refused) if score else (read, refused + 1)
        peak = tracemalloc.get_traced_memory()[1]
        if took > LONGEST_S or peak > MOST_BYTES:
            Path(f"fuzz-{seed}-{number}.bin").write_bytes(data)
            print(f"file {number} of seed {seed}: {took:.2f} s, peak {peak / 2**20:.0f} MiB")
            return 1
    rate = files / (time.perf_counter() - begin)
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    print(f"{files} files: {read} read, {refused} refused; {rate:.0f} a second")
    print(f"slowest {slowest * 1000:.0f} ms, peak {peak:.1f} MiB")
    return 0


if __name__ == "__main__":
    arguments = [int(argument) for argument in sys.argv[1:]]
    sys.exit(main(*arguments, *(50_000, 1)[len(arguments) :]))
