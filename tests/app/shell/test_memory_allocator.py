"""Memory that is freed goes back to the system, where the C library can be asked for that."""

import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app.shell import memory_allocator

PROGRAM = """
import sys
import numpy as np
from pathlib import Path
from rotemina.app.shell.memory_allocator import give_back, trim_heap

def resident_mb():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

arrays, size = map(int, sys.argv[1:3])
if trim_heap():
    np.ones(3_000_000)  # after which large sizes would be kept, left to itself
    before = resident_mb()
    kept, freed = [], []
    for _ in range(arrays):
        freed.append(np.ones(size))
        kept.append(np.ones(1000))
    freed.clear()
    if size < 100_000:  # those that are larger go by themselves
        give_back()
    print(resident_mb() - before)
"""


@pytest.mark.skipif(not Path("/proc/self/statm").is_file(), reason="memory is read in /proc")
@pytest.mark.parametrize(("arrays", "size"), [(40, 200_000), (400, 20_000)])
def test_arrays_that_are_freed_leave_nothing(arrays, size):
    command = [sys.executable, "-c", PROGRAM, str(arrays), str(size)]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert not told or float(told) < 10.0  # of 64 MB; nothing is told by another C library


def test_elsewhere_nothing_is_asked(monkeypatch):
    monkeypatch.setattr(memory_allocator.sys, "platform", "win32")
    assert not memory_allocator.trim_heap()
    assert not memory_allocator.give_back()
