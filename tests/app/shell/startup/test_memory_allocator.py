"""Freed memory goes back to the system if the C library supports it."""

import subprocess
import sys
from pathlib import Path

import pytest

from rotemina.app.shell.startup import memory_allocator

PROGRAM = """
import sys
import numpy as np
from pathlib import Path
from rotemina.app.shell.startup.memory_allocator import release_free_memory, configure_allocator

def resident_mb():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

arrays, size = map(int, sys.argv[1:3])
if configure_allocator():
    np.ones(3_000_000)  # after this, malloc would keep large blocks by default
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
@pytest.mark.parametrize(("arrays", "size"), [(40, 200_000), (400, 20_000)])
def test_freed_arrays_are_returned_to_the_system(arrays, size):
    command = [sys.executable, "-c", PROGRAM, str(arrays), str(size)]
    growth_mb = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert not growth_mb or float(growth_mb) < 10.0  # of 64 MB; empty with another C library


def test_nothing_is_done_on_other_systems(monkeypatch):
    monkeypatch.setattr(memory_allocator.sys, "platform", "win32")
    assert not memory_allocator.configure_allocator()
    assert not memory_allocator.release_free_memory()
