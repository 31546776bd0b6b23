"""Import and export: 1 000 000 rows by 13 columns, compared with pandas and pyarrow.

``make bench`` runs it and checks the limits; ``python tests/benchmarks/bench_records.py ROWS`` only
prints. All libraries take turns in one run, so that a slow phase of the machine affects all of
them. The export of pandas takes half a minute and has only one turn. The extra ``bench`` is needed.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from math import inf
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.csv

from rotemina.sim.records import Record, Tap, read_record, write_record

ROWS = 1_000_000
CHANNELS = 12
TURNS = 3
ONE_TURN = "pandas, one turn"

MAX_RATIO_TO_THE_FASTEST = 2.0
MAX_RATIO_TO_THE_ARRAY = 5.0
QUICK = {
    "ROWS": 1000,
    "TURNS": 1,
    "MAX_RATIO_TO_THE_FASTEST": inf,
    "MAX_RATIO_TO_THE_ARRAY": inf,
}

MEMORY_PROBE = """
import sys
import psutil
from rotemina.sim.records import read_record
from rotemina.sim.records import write_record
task, source, target = sys.argv[1:]
def peak_bytes():
    if sys.platform == "win32":
        return psutil.Process().memory_info().peak_wset
    if sys.platform == "darwin":
        import resource
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # Not ru_maxrss, which on Linux begins with the peak of the parent process.
    status = open("/proc/self/status").read()
    return 1024 * int(status.split("VmHWM:")[1].split()[0])
before = psutil.Process().memory_info().rss
record = read_record(source)
if task == "export":
    write_record(record, target)
print(peak_bytes() - before)
"""


def test_import_and_export_stay_within_their_limits() -> None:
    slowness, growth = main()
    assert slowness <= MAX_RATIO_TO_THE_FASTEST
    assert growth <= MAX_RATIO_TO_THE_ARRAY


def main(rows: int = ROWS) -> tuple[float, float]:
    """Measure and print; return our worst time and our worst peak as ratios to the others."""
    array_bytes = 8 * rows * (CHANNELS + 1)
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "source.csv"), Path(folder, "target.csv")
        record = make_record(rows)
        write_record(record, source)
        print(f"\n{rows} rows x {CHANNELS + 1} columns, {source.stat().st_size / 1e6:.0f} MB")
        import_times_s, export_times_s = (
            measure(make_importers(source)),
            measure(make_exporters(record, target)),
        )
        print("            import, s  export, s")
        for name, reading_s, writing_s in zip(
            import_times_s, import_times_s.values(), export_times_s.values(), strict=True
        ):
            print(f"{name:11} {reading_s:9.2f} {writing_s:10.2f}")
        slowness = [compute_slowness(import_times_s), compute_slowness(export_times_s)]
        peaks = [measure_peak_growth(task, source, target) for task in ("import", "export")]
    print("peak, MB   ", *(f"{peak / 1e6:10.0f}" for peak in peaks))
    print("x the array", *(f"{peak / array_bytes:10.2f}" for peak in peaks))
    return max(slowness), max(peaks) / array_bytes


def make_record(rows: int) -> Record:
    """Return noise of full precision in twelve channels at 1 kHz."""
    noise = np.random.default_rng(0).normal(scale=1e-5, size=(CHANNELS, rows))
    axes = [f"a{number}" for number in range(CHANNELS)]
    signals = {(axis, Tap.CMD): signal for axis, signal in zip(axes, noise, strict=True)}
    return Record.from_signals(np.arange(rows) / 1000, signals, dict.fromkeys(axes, "m"))


def make_importers(source: Path) -> Mapping[str, Callable[[], object]]:
    """Return the functions that read the file; only ours also checks it."""
    return {
        "rotemina": lambda: read_record(source),
        "pyarrow": lambda: pa.csv.read_csv(source, pa.csv.ReadOptions(skip_rows=1)),
        "pandas": lambda: pd.read_csv(source, comment="#"),
    }


def make_exporters(record: Record, target: Path) -> Mapping[str, Callable[[], object]]:
    """Return the functions that write the same numbers from a table of each library to the disk.

    Ours syncs the file itself; for the others a sync is added.
    """
    names = ["t [s]", *(f"{column} [m]" for column in record.columns)]
    columns = [record.time_s, *record.values.T]
    frame = pd.DataFrame(dict(zip(names, columns, strict=True)))
    arrow = pa.table(dict(zip(names, columns, strict=True)))
    return {
        "rotemina": lambda: write_record(record, target),
        "pyarrow": sync_after(target, lambda: pa.csv.write_csv(arrow, target)),
        ONE_TURN: sync_after(target, lambda: frame.to_csv(target, index=False)),
    }


def sync_after(target: Path, write: Callable[[], object]) -> Callable[[], None]:
    """Return a function that writes a file and waits until it is on the disk."""

    def task() -> None:
        write()
        with target.open("rb+") as file:
            os.fsync(file.fileno())

    return task


def measure(tasks: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    """Return the median time of each task, s; the tasks take turns after an unmeasured round."""
    seconds: dict[str, list[float]] = {name: [] for name in tasks}
    for turn in range(TURNS + 1):
        for name, task in tasks.items():
            if name == ONE_TURN and turn != 1:
                continue
            start = time.perf_counter()
            task()
            if turn > 0:
                seconds[name].append(time.perf_counter() - start)
    return {name: statistics.median(times_s) for name, times_s in seconds.items()}


def compute_slowness(seconds: Mapping[str, float]) -> float:
    """Return our time divided by that of the fastest other library."""
    fastest = min(value for name, value in seconds.items() if name != "rotemina")
    return seconds["rotemina"] / fastest


def measure_peak_growth(task: str, source: Path, target: Path) -> int:
    """Return the peak growth of a separate process, bytes, including its imports."""
    command = [sys.executable, "-c", MEMORY_PROBE, task, str(source), str(target)]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
