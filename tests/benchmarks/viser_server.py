"""A server of viser with 70 bones that turn 60 times a second, for bench_stream.py to watch.

Run by the peers' own Python (requirements/peers.in), which has no Reina. Prints ``port N``, and from the
first line of its input on sets every bone's orientation at absolute deadlines. Each frame is one atomic
update, flushed at once: left to itself viser waits up to a sixtieth of a second, and joins frames.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import threading
import time
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import numpy as np


def turning(bones: int, frames: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """A second of unit quaternions w x y z, (frames, bones, 4); every bone turns in every frame."""
    phase = np.linspace(0.0, 2.0 * np.pi, frames, endpoint=False)[:, None] + np.arange(bones)
    half = 0.25 * np.sin(phase)
    axis = np.array([0.6, 0.48, 0.64])
    return np.concatenate([np.cos(half)[..., None], np.sin(half)[..., None] * axis], axis=-1)


def main() -> None:
    """Serve until the input ends."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bones", type=int, default=70)
    parser.add_argument("--fps", type=float, default=60.0)
    options = parser.parse_args()
    viser: Any = importlib.import_module("viser")
    with redirect_stdout(StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=18_080, verbose=False)
    poses = turning(options.bones, int(options.fps))
    at = np.stack([np.linspace(0.0, 1.0, options.bones), *np.zeros((2, options.bones))], axis=-1)
    mesh = server.scene.add_mesh_skinned(
        "/player",
        vertices=at + np.array([0.0, 0.01, 0.0]),
        faces=np.array([[bone, bone + 1, bone + 2] for bone in range(0, options.bones - 2, 3)]),
        bone_wxyzs=poses[0],
        bone_positions=at,
        skin_weights=np.eye(options.bones),
    )
    print("port", server.get_port(), flush=True)
    sys.stdin.readline()
    over = threading.Thread(target=sys.stdin.readline, daemon=True)
    over.start()
    due_s, frame = time.monotonic(), 0
    while over.is_alive():
        with server.atomic():
            for bone, wxyz in zip(mesh.bones, poses[frame % len(poses)], strict=True):
                bone.wxyz = wxyz
        server.flush()
        due_s, frame = due_s + 1 / options.fps, frame + 1
        time.sleep(max(0.0, due_s - time.monotonic()))


if __name__ == "__main__":
    main()
