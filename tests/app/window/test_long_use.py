"""A window in long use does not accumulate memory."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

MEMORY_BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "bench_memory.py"


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/smaps_rollup").is_file(), reason="memory is read in /proc")
def test_playbacks_and_actions_do_not_accumulate_memory():
    # Views allocate caches on first use, which is within the first half.
    process = subprocess.run(
        [sys.executable, MEMORY_BENCHMARK, "--plays", "20", "--actions", "200", "--after", "0.5"],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert process.returncode == 0, process.stderr[-4000:]
    result = json.loads(process.stdout)
    growth_percent, type_growth = result["grown_percent"], result["most_grown"]
    assert type_growth.get("rotemina.sim.records.record.Record", 0) <= 3, type_growth
    assert growth_percent["objects"] <= 2.0, type_growth
    assert growth_percent["widgets"] <= 5.0, type_growth
    assert growth_percent["threads"] <= 30.0, result["looks"]
    assert growth_percent["files"] <= 30.0, result["looks"]
    assert growth_percent["rss_mb"] <= 10.0, result["looks"]
