"""Freed memory goes back to the system if the C library supports it."""

import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app.shell.startup import memory_allocator

PROGRAM = """
import numpy as np
from pathlib import Path
from rotemina.app.shell.startup.memory_allocator import release_free_memory, configure_allocator

def resident_mb():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

if configure_allocator():
    np.ones(3_000_000)  # after this, malloc would keep large blocks by default
    for arrays, size in ((40, 200_000), (400, 20_000)):
        before = resident_mb()
        kept, freed = [], []
        for _ in range(arrays):
            freed.append(np.ones(size))
            kept.append(np.ones(1000))
        freed.clear()
        if size < 100_000:  # larger ones are released automatically
            release_free_memory()
        print(resident_mb() - before)
"""


@pytest.mark.skipif(not Path("/proc/self/statm").is_file(), reason="memory is read in /proc")
def test_large_and_small_freed_arrays_are_returned_to_the_system():
    command = [sys.executable, "-c", PROGRAM]
    growths_mb = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    # Of 64 MB each; there is no output with another C library.
    assert all(float(growth_mb) < 10.0 for growth_mb in growths_mb)


def test_nothing_is_done_on_other_systems(monkeypatch):
    monkeypatch.setattr(memory_allocator.sys, "platform", "win32")
    assert not memory_allocator.configure_allocator()
    assert not memory_allocator.release_free_memory()
