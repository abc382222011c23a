"""`reina bake` with workers that die of a score called `poison.mid`, however often it comes.

python -m tests.integration.poisoned_bake FOLDER ...
"""

from __future__ import annotations

import os
import signal
import sys

from reina.cli import main
from reina.cli.bake import work

REALLY = work.begin


def begin(order: work.ScoreOrder, parts: frozenset[str]) -> tuple[work.Outline, work.Files]:
    """What a worker does: it imports this module, where nothing has been put in the place of the other."""
    if order.filename == "poison.mid":
        os.kill(os.getpid(), signal.SIGKILL)
    return REALLY(order, parts)


if __name__ == "__main__":
    from tests.integration import poisoned_bake

    work.begin = poisoned_bake.begin
    sys.exit(main(["bake", *sys.argv[1:]]))
