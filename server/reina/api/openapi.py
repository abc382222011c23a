"""Write the description of the HTTP interface, or check that what is there still holds.

    python -m reina.api.openapi [--check]

Writes docs/openapi.json, which a running server also answers with at /openapi.json.
"""

from __future__ import annotations

import argparse
import json

from reina.api.app import create_app
from reina.protocol.generate import ROOT, write_or_check


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m reina.api.openapi", description=__doc__)
    parser.add_argument("--check", action="store_true", help="change nothing; fail when it is stale")
    arguments = parser.parse_args()
    text = json.dumps(create_app().openapi(), indent=1, ensure_ascii=False) + "\n"
    return write_or_check({ROOT / "docs/openapi.json": text}, check=arguments.check)


if __name__ == "__main__":
    raise SystemExit(main())
