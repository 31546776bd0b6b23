"""Memory that is freed goes back to the system, where the C library can be asked for that."""

import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app.shell import memory_allocator

BEGIN = """
import numpy as np
from pathlib import Path
from rotemina.app.shell.memory_allocator import give_back, trim_heap

def resident_mb():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6
"""
LARGE = """
if trim_heap():
    np.ones(3_000_000)  # after which such sizes would be kept, left to itself
    before = resident_mb()
    kept, freed = [], []
    for _ in range(40):
        freed.append(np.ones(200_000))
        kept.append(np.ones(1000))
    freed.clear()
    print(resident_mb() - before)
"""
SMALL = """
if trim_heap():
    before = resident_mb()
    kept, freed = [], []
    for _ in range(400):
        freed.append(np.ones(20_000))
        kept.append(np.ones(1000))
    freed.clear()
    give_back()
    print(resident_mb() - before)
"""


@pytest.mark.skipif(not Path("/proc/self/statm").is_file(), reason="memory is read in /proc")
@pytest.mark.parametrize("use", [LARGE, SMALL], ids=["large", "small"])
def test_arrays_that_are_freed_leave_nothing(use):
    told = subprocess.run(
        [sys.executable, "-c", BEGIN + use], check=True, capture_output=True, text=True
    ).stdout
    assert not told or float(told) < 10.0  # of 64 MB; nothing is told by another C library


def test_elsewhere_nothing_is_asked(monkeypatch):
    monkeypatch.setattr(memory_allocator.sys, "platform", "win32")
    assert not memory_allocator.trim_heap()
    assert not memory_allocator.give_back()
