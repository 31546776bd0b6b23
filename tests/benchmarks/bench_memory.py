"""Memory of the window in long use: playback, and random actions of menus, palette and panels.

Limit: after the first tenth it grows by at most 5 %. Started directly it prints the memory of the
requested use as JSON: ``python tests/benchmarks/bench_memory.py --plays 60 --actions 999``.
"""

import argparse
import collections
import gc
import json
import logging
import subprocess
import sys
import threading
import time
from pathlib import Path

PLAYS, ACTIONS = 500, 10_000
# Memory is measured after each part of the use.
PARTS = 20
LIMIT_PERCENT = 5.0
QUICK = {"PLAYS": 4, "ACTIONS": 8}


def measure_memory_mb() -> dict[str, float]:
    """Return the memory of the program, MB: resident, proportional share, and private."""
    names = {"Rss": "rss_mb", "Pss": "pss_mb", "Private_Dirty": "private_mb"}
    memory = {}
    for line in Path("/proc/self/smaps_rollup").read_text().splitlines()[1:]:
        name, _, rest = line.partition(":")
        if name in names:
            memory[names[name]] = int(rest.split()[0]) / 1024.0
    return memory


def count_objects() -> collections.Counter:
    """Return the number of objects of each type."""
    # No other thread may run: a reference to a tuple that it is filling would make that fail.
    interval_s = sys.getswitchinterval()
    sys.setswitchinterval(1.0)
    # Threads that are already waiting still use the previous switch interval.
    time.sleep(0.01)
    types = map(type, gc.get_objects())
    counts = collections.Counter(f"{kind.__module__}.{kind.__qualname__}" for kind in types)
    sys.setswitchinterval(interval_s)
    return counts


def measure_use(
    plays: int, actions: int, *, after: float = 0.1, trace: bool = False
) -> dict[str, object]:
    """Use a window; return the memory after each part, and its growth after a share of the use."""
    import tracemalloc

    from PySide6.QtWidgets import QApplication
    from window_use import WindowUse

    from rotemina.app.shell.startup.memory_allocator import release_free_memory
    from rotemina.app.shell.startup.window_run import start_memory_upkeep
    from rotemina.plugins.gap.diagnosing import record_selection as records

    # The list of records must be full before growth counts, however short the use is.
    records.MAX_UNTICKED_RECORDS = min(
        records.MAX_UNTICKED_RECORDS, max(round(0.5 * after * plays), 1)
    )
    logging.basicConfig(level=logging.ERROR)
    window_use = WindowUse()
    # As in the program.
    end_upkeep = start_memory_upkeep(window_use.application)
    measurements, counts, began_s = [], [], time.monotonic()
    first_snapshot, first_counted = None, round(after * PARTS)
    for part in range(PARTS + 1):
        if part:
            for _ in range(round(plays / PARTS)):
                window_use.play()
                window_use.run_random_entries(round(actions / plays))
        window_use.settle(0.3)
        gc.collect()
        # Free memory does not count.
        release_free_memory()
        if part == first_counted and trace:
            tracemalloc.start(12)
            first_snapshot = tracemalloc.take_snapshot()
        counts.append(count_objects())
        measurements.append(
            {
                "plays": round(plays / PARTS) * part,
                "s": round(time.monotonic() - began_s, 1),
                **{name: round(value, 1) for name, value in measure_memory_mb().items()},
                "objects": sum(counts[-1].values()),
                "widgets": len(QApplication.allWidgets()),
                "threads": threading.active_count(),
                "files": len(list(Path("/proc/self/fd").iterdir())),
            }
        )
        print(json.dumps(measurements[-1]), file=sys.stderr, flush=True)
    more_objects = counts[-1] - counts[first_counted]
    if first_snapshot is not None:
        for statistic in tracemalloc.take_snapshot().compare_to(first_snapshot, "traceback")[:15]:
            print(statistic, *statistic.traceback.format(), sep="\n", file=sys.stderr)
    growth = {
        name: round(100.0 * (measurements[-1][name] / measurements[first_counted][name] - 1.0), 2)
        for name in ("rss_mb", "pss_mb", "private_mb", "objects", "widgets", "threads", "files")
    }
    end_upkeep()
    window_use.close()
    return {
        "looks": measurements,
        "grown_percent": growth,
        "most_grown": dict(more_objects.most_common(25)),
    }


def test_memory():
    process = subprocess.run(
        [sys.executable, __file__, "--plays", str(PLAYS), "--actions", str(ACTIONS)],
        check=False,
        capture_output=True,
        text=True,
    )
    assert process.returncode == 0, process.stderr[-4000:]
    result = json.loads(process.stdout)
    growth = ", ".join(f"{name} {share}" for name, share in result["grown_percent"].items())
    print(
        f"\n{PLAYS} plays, {ACTIONS} actions, growth after the first tenth, %: {growth}; limit of "
        f"rss {LIMIT_PERCENT}"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plays", type=int, default=PLAYS)
    parser.add_argument("--actions", type=int, default=ACTIONS)
    parser.add_argument("--after", type=float, default=0.1, help="share from which growth counts")
    parser.add_argument("--trace", action="store_true", help="print where memory was allocated")
    options = parser.parse_args()
    result = measure_use(options.plays, options.actions, after=options.after, trace=options.trace)
    print(json.dumps(result, indent=1))
