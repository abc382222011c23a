"""Probes one recording in a process of its own, started by `reina.sound.recording.decoder`.

    python -m reina.sound.recording.worker SONG PEAKS [FLAC [--forced]]

On standard output it tells, as one JSON object, what `probe_recording` says, or ``{"error": "..."}``, or
``{"errno": 28}`` where there is no room for what it writes. The peaks are written to PEAKS, and what browsers
do not play, or anything where that is forced, to FLAC. Standard input stays open: when it is closed, the one
who asked is gone, and the process ends.
"""

import json
import mmap
import os
import sys
import threading
from dataclasses import asdict
from pathlib import Path

from reina.errors import InputError
from reina.sound.recording.peaks import write_peaks
from reina.sound.recording.probe import Conversion, probe_recording
from reina.system.disk_room import is_disk_full
from reina.system.own_process import bound_memory, complain_in_a_line, end_with_parent, yield_to_server

MAX_MEMORY_BYTES = 1_500_000_000
"""Address space, most of it libraries; a decoder that wants more fails."""


def main() -> int:
    """Probe, and tell."""
    song, peaks_file = Path(sys.argv[1]), Path(sys.argv[2])
    conversion = Conversion(Path(sys.argv[3]), "--forced" in sys.argv[4:]) if len(sys.argv) > 3 else None
    complain_in_a_line()
    yield_to_server()
    bound_memory(MAX_MEMORY_BYTES)
    threading.Thread(target=end_with_parent, daemon=True).start()
    _silence_libraries()
    try:
        with song.open("rb") as file:
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if song.stat().st_size else b""
            info, peaks = probe_recording(data, conversion)
        if peaks is not None:
            write_peaks(peaks_file, peaks)
    except InputError as error:
        _tell({"error": str(error)})
        return 0
    except OSError as error:
        if not is_disk_full(error):
            raise
        _tell({"errno": error.errno})
        return 0
    _tell(asdict(info))
    return 0


def _tell(message: dict[str, object]) -> None:
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


def _silence_libraries() -> None:
    """Let what decoders print go nowhere; what Python tells of its own end still goes to standard error."""
    sys.stderr = os.fdopen(os.dup(2), "w")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    os.close(nowhere)


if __name__ == "__main__":
    sys.exit(main())
