"""Memory of the window in long use: plays, and actions of menus, palette and panels by chance.

Limit: after the first tenth it grows by at most 5 %. As a program of its own it tells of the use
that it is asked for, as JSON: ``python tests/benchmarks/bench_memory.py --plays 60 --actions 999``.
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
PARTS = 20  # between which memory is looked at
LIMIT_PERCENT = 5.0
QUICK = {"PLAYS": 4, "ACTIONS": 8}


def memory_mb() -> dict[str, float]:
    """Return the program's memory, MB: resident, and its own share of what is mapped."""
    wanted = {"Rss": "rss_mb", "Pss": "pss_mb", "Private_Dirty": "private_mb"}
    found = {}
    for line in Path("/proc/self/smaps_rollup").read_text().splitlines()[1:]:
        name, _, rest = line.partition(":")
        if name in wanted:
            found[wanted[name]] = int(rest.split()[0]) / 1024.0
    return found


def kinds() -> collections.Counter:
    """Return how many objects there are of each type."""
    # No other thread may run: a tuple that it is filling would be shared, and filling it fail.
    interval_s = sys.getswitchinterval()
    sys.setswitchinterval(1.0)
    time.sleep(0.01)  # threads that wait already do so by the interval before
    types = map(type, gc.get_objects())
    found = collections.Counter(f"{one.__module__}.{one.__qualname__}" for one in types)
    sys.setswitchinterval(interval_s)
    return found


def use(plays: int, actions: int, *, after: float = 0.1, trace: bool = False) -> dict[str, object]:
    """Use a window; return what it took after each part, and how that grew after a share of all."""
    import tracemalloc

    from PySide6.QtWidgets import QApplication
    from window_use import UsedWindow

    from rotemina.app.shell.memory_allocator import give_back
    from rotemina.app.shell.window_run import tidy_memory
    from rotemina.plugins.gap import records

    # The list of records is full before growth counts, however short the use.
    records.MOST_UNTICKED = min(records.MOST_UNTICKED, max(round(0.5 * after * plays), 1))
    logging.basicConfig(level=logging.ERROR)
    used = UsedWindow()
    end_tidying = tidy_memory(used.application)  # as the program does
    looks, counts, began_s = [], [], time.monotonic()
    first, begun = None, round(after * PARTS)
    for part in range(PARTS + 1):
        if part:
            for _ in range(round(plays / PARTS)):
                used.play()
                used.act(round(actions / plays))
        used.settle(0.3)
        gc.collect()
        give_back()  # what is free is not counted
        if part == begun and trace:
            tracemalloc.start(12)
            first = tracemalloc.take_snapshot()
        counts.append(kinds())
        looks.append(
            {
                "plays": round(plays / PARTS) * part,
                "s": round(time.monotonic() - began_s, 1),
                **{name: round(value, 1) for name, value in memory_mb().items()},
                "objects": sum(counts[-1].values()),
                "widgets": len(QApplication.allWidgets()),
                "threads": threading.active_count(),
                "files": len(list(Path("/proc/self/fd").iterdir())),
            }
        )
        print(json.dumps(looks[-1]), file=sys.stderr, flush=True)
    grown = counts[-1] - counts[begun]
    if first is not None:
        for one in tracemalloc.take_snapshot().compare_to(first, "traceback")[:15]:
            print(one, *one.traceback.format(), sep="\n", file=sys.stderr)
    growth = {
        name: round(100.0 * (looks[-1][name] / looks[begun][name] - 1.0), 2)
        for name in ("rss_mb", "pss_mb", "private_mb", "objects", "widgets", "threads", "files")
    }
    end_tidying()
    used.close()
    return {"looks": looks, "grown_percent": growth, "most_grown": dict(grown.most_common(25))}


def test_memory():
    told = subprocess.run(
        [sys.executable, __file__, "--plays", str(PLAYS), "--actions", str(ACTIONS)],
        check=False,
        capture_output=True,
        text=True,
    )
    assert told.returncode == 0, told.stderr[-4000:]
    found = json.loads(told.stdout)
    grown = ", ".join(f"{name} {share}" for name, share in found["grown_percent"].items())
    print(
        f"\n{PLAYS} plays, {ACTIONS} actions, growth after the first tenth, %: {grown}; limit of "
        f"rss {LIMIT_PERCENT}"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plays", type=int, default=PLAYS)
    parser.add_argument("--actions", type=int, default=ACTIONS)
    parser.add_argument("--after", type=float, default=0.1, help="share from which growth counts")
    parser.add_argument("--trace", action="store_true", help="tell where memory was asked for")
    options = parser.parse_args()
    found = use(options.plays, options.actions, after=options.after, trace=options.trace)
    print(json.dumps(found, indent=1))
