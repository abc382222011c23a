"""Memory that was freed goes back to the system."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

MAPPED = """
import ctypes, sys
from reina.system.heap import return_large_blocks

class Told(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in "arena ordblks smblks hblks hblkhd".split()]
    _fields_ += [(name, ctypes.c_size_t) for name in "usmblks fsmblks uordblks fordblks keepcost".split()]

if sys.argv[1] == "set":
    assert return_large_blocks()
told = ctypes.CDLL(None).mallinfo2
told.restype = Told
del [bytes(30_000_000)][:]
before = told().hblks
held = [bytes(1_000_000) for _ in range(10)]
print(told().hblks - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another malloc")
@pytest.mark.parametrize(("way", "mapped"), [("set", 10), ("as it is", 0)])
def test_large_blocks_are_mappings_whatever_was_freed_before(way: str, mapped: int) -> None:
    told = subprocess.run([sys.executable, "-c", MAPPED, way], check=True, capture_output=True, text=True)
    assert int(told.stdout) == mapped
