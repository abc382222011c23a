"""The server's child processes, seen from the server."""

from __future__ import annotations

import subprocess
import sys

import pytest

from reina.system.process_metrics import worker_processes

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="no other system has /proc")

BUSY = """
import sys, time
until = time.process_time() + 0.3
while time.process_time() < until:
    pass
print("done", flush=True)
sys.stdin.read()
"""


def test_a_childs_memory_and_time_are_told_while_it_lives_and_its_time_afterwards() -> None:
    before = worker_processes()
    assert before is not None
    child = subprocess.Popen([sys.executable, "-c", BUSY], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdout is not None
    assert child.stdout.readline() == b"done\n"
    during = worker_processes()
    child.communicate()
    after = worker_processes()
    assert during is not None
    assert after is not None
    assert (during.count, after.count) == (before.count + 1, before.count)
    assert during.resident_bytes > before.resident_bytes + 1_000_000
    assert during.cpu_s >= before.cpu_s + 0.25
    # What it took is counted once, and does not go with it.
    assert during.cpu_s <= after.cpu_s + 0.02
