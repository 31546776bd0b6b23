"""Import and export: 1 000 000 rows by 13 columns, beside pandas, polars and pyarrow.

``make bench`` runs it and holds it to its bounds; ``python tests/benchmarks/bench_records.py ROWS``
only prints. All take turns in one run, so that a slow moment of the machine meets them all; the
export of pandas, which takes half a minute, has one turn. It needs the extra ``bench``.
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
import polars as pl
import pyarrow as pa
import pyarrow.csv

from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

ROWS = 1_000_000
CHANNELS = 12
TURNS = 3
ONE_TURN = "pandas, one turn"

MOST_TIMES_THE_FASTEST = 2.0
MOST_TIMES_THE_ARRAY = 5.0
QUICK = {
    "ROWS": 1000,
    "TURNS": 1,
    "MOST_TIMES_THE_FASTEST": inf,
    "MOST_TIMES_THE_ARRAY": inf,
}

MEMORY_PROBE = """
import sys
import psutil
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.writing import write_record
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


def test_import_and_export_keep_to_their_bounds() -> None:
    slowness, growth = main()
    assert slowness <= MOST_TIMES_THE_FASTEST
    assert growth <= MOST_TIMES_THE_ARRAY


def main(rows: int = ROWS) -> tuple[float, float]:
    """Measure and print; return the worst of our times and of our peaks, as ratios."""
    array_bytes = 8 * rows * (CHANNELS + 1)
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "source.csv"), Path(folder, "target.csv")
        record = make_record(rows)
        write_record(record, source)
        print(f"\n{rows} rows x {CHANNELS + 1} columns, {source.stat().st_size / 1e6:.0f} MB")
        read, written = measure(importers(source)), measure(exporters(record, target))
        print("            import, s  export, s")
        for own, one, other in zip(read, read.values(), written.values(), strict=True):
            print(f"{own:11} {one:9.2f} {other:10.2f}")
        slowness = [slowness_of(read), slowness_of(written)]
        peaks = [peak_growth(task, source, target) for task in ("import", "export")]
    print("peak, MB   ", *(f"{peak / 1e6:10.0f}" for peak in peaks))
    print("x the array", *(f"{peak / array_bytes:10.2f}" for peak in peaks))
    return max(slowness), max(peaks) / array_bytes


def make_record(rows: int) -> Record:
    """Return noise of full precision in twelve channels at 1 kHz."""
    noise = np.random.default_rng(0).normal(scale=1e-5, size=(CHANNELS, rows))
    axes = [f"a{number}" for number in range(CHANNELS)]
    signals = {(axis, Tap.CMD): signal for axis, signal in zip(axes, noise, strict=True)}
    return Record.from_signals(np.arange(rows) / 1000, signals, dict.fromkeys(axes, "m"))


def importers(source: Path) -> Mapping[str, Callable[[], object]]:
    """Return what reads the file: ours checks it, the others take it as it is."""
    return {
        "rotemina": lambda: read_record(source),
        "polars": lambda: pl.read_csv(source, comment_prefix="#"),
        "pyarrow": lambda: pa.csv.read_csv(source, pa.csv.ReadOptions(skip_rows=1)),
        "pandas": lambda: pd.read_csv(source, comment="#"),
    }


def exporters(record: Record, target: Path) -> Mapping[str, Callable[[], object]]:
    """Return what writes the same numbers from each library's own table, each up to the disk.

    Ours is on the disk when it returns; the others leave that to the system.
    """
    names = ["t [s]", *(f"{column} [m]" for column in record.columns)]
    columns = [record.time_s, *record.values.T]
    frame = pd.DataFrame(dict(zip(names, columns, strict=True)))
    table = pl.DataFrame(dict(zip(names, columns, strict=True)))
    arrow = pa.table(dict(zip(names, columns, strict=True)))
    return {
        "rotemina": lambda: write_record(record, target),
        "polars": to_disk(target, lambda: table.write_csv(target)),
        "pyarrow": to_disk(target, lambda: pa.csv.write_csv(arrow, target)),
        ONE_TURN: to_disk(target, lambda: frame.to_csv(target, index=False)),
    }


def to_disk(target: Path, write: Callable[[], object]) -> Callable[[], None]:
    """Return what writes a file and waits until it is on the disk."""

    def task() -> None:
        write()
        with target.open("rb+") as file:
            os.fsync(file.fileno())

    return task


def measure(tasks: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    """Return the median seconds of each task, which take turns after one unmeasured round."""
    seconds: dict[str, list[float]] = {name: [] for name in tasks}
    for turn in range(TURNS + 1):
        for name, task in tasks.items():
            if name == ONE_TURN and turn != 1:
                continue
            start = time.perf_counter()
            task()
            if turn > 0:
                seconds[name].append(time.perf_counter() - start)
    return {name: statistics.median(each) for name, each in seconds.items()}


def slowness_of(seconds: Mapping[str, float]) -> float:
    """Return our seconds divided by those of the fastest of the others."""
    fastest = min(value for name, value in seconds.items() if name != "rotemina")
    return seconds["rotemina"] / fastest


def peak_growth(task: str, source: Path, target: Path) -> int:
    """Return by how many bytes a process of its own grows at most, imports of code included."""
    command = [sys.executable, "-c", MEMORY_PROBE, task, str(source), str(target)]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
