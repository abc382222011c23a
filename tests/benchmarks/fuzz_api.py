"""Call a server of its own in any order, for longer than `tests/integration/test_api_states.py` does.

.venv/bin/python -m tests.benchmarks.fuzz_api --calls 20000
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from tests.integration.api_states import CallsInAnyOrder
from tests.integration.server import serve


def main() -> None:
    """Call, and print how often what was answered how; what is not as described ends it."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--calls", type=int, default=5000, help="how many, at least")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder), "--no-page") as running:
        called = CallsInAnyOrder(running.address)
        try:
            called.run(arguments.calls)
        finally:
            for (method, path, status), count in sorted(called.calls.items()):
                print(f"{count:6} {method:6} {status} {path}")


if __name__ == "__main__":
    main()
