"""A window in long use keeps nothing of what was played and done."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).parents[2] / "benchmarks" / "bench_memory.py"


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/smaps_rollup").is_file(), reason="memory is read in /proc")
def test_plays_and_actions_leave_nothing_behind():
    # What views keep from their first use on is there after the first half.
    told = subprocess.run(
        [sys.executable, PROGRAM, "--plays", "20", "--actions", "400", "--after", "0.5"],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert told.returncode == 0, told.stderr[-4000:]
    found = json.loads(told.stdout)
    grown, kinds = found["grown_percent"], found["most_grown"]
    assert kinds.get("rotemina.sim.records.record.Record", 0) <= 3, kinds
    assert grown["objects"] <= 2.0, kinds
    assert grown["widgets"] <= 5.0, kinds
    assert grown["threads"] <= 30.0, found["looks"]
    assert grown["files"] <= 30.0, found["looks"]
    assert grown["rss_mb"] <= 10.0, found["looks"]
