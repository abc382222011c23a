"""Kill a server while it writes, over and over, and see that nothing is lost that it acknowledged.

Run as ``python tests/soak/kill.py --kills 1000``; with ``--postgresql`` on a PostgreSQL that is started for
it. Each round has a server killed after a random time, and another one looked into.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
from contextlib import nullcontext
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.integration.killed import (  # noqa: E402
    Writer,
    check_acknowledged,
    client_of,
    kill_in_the_middle,
    options,
)
from tests.integration.server import serve  # noqa: E402
from tests.servers.postgresql import postgresql  # noqa: E402

TOLD_EVERY = 5


def main() -> int:
    """Kill, check, and say how much was acknowledged."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--postgresql", action="store_true", help="keep sessions in PostgreSQL")
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    acknowledged = 0
    writer: Writer | None = None
    running = postgresql(fsync=True) if arguments.postgresql else nullcontext()
    with tempfile.TemporaryDirectory() as folder, running as server:
        started = options(server.database() if server else "")
        for kill in range(1, arguments.kills + 1):
            writer = kill_in_the_middle(Path(folder), started, chance, writer)
            acknowledged += writer.writes
            if kill % TOLD_EVERY == 0:
                print(f"{kill} kills, {acknowledged} acknowledged writes", flush=True)
        if writer is not None:
            with serve(Path(folder), *started) as last, client_of(last) as client:
                check_acknowledged(client, writer)
    print(f"{arguments.kills} kills, {acknowledged} acknowledged writes, none lost")
    return 0


if __name__ == "__main__":
    sys.exit(main())
