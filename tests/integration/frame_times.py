"""Watches a session from a process of its own: when each frame came, and when it was to be sent.

    python tests/integration/frame_times.py ws://.../stream

Prints "joined"; when standard input is closed, a JSON list of [came, was to be sent], server time in seconds.
"""

from __future__ import annotations

import json
import struct
import sys
import threading
import time

import websockets
from websockets.sync.client import connect

LEAD_S = 0.1
HEADER = struct.Struct("<BBHIdd")
PLAYING = 1


def main() -> int:
    """Watch until standard input is closed."""
    times: list[tuple[float, float]] = []
    subprotocols = [websockets.Subprotocol("reina.v1")]
    with connect(sys.argv[1], subprotocols=subprotocols, max_size=None, compression=None) as socket:

        def watch() -> None:
            for message in socket:
                now = time.monotonic()
                if isinstance(message, bytes):
                    _, _, flags, _, _, due = HEADER.unpack_from(message)
                    if flags & PLAYING:
                        times.append((now, due - LEAD_S))

        print("joined", flush=True)
        threading.Thread(target=watch, daemon=True).start()
        sys.stdin.read()
        print(json.dumps(times), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
