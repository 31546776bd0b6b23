"""Peak memory of ``rotemina simulate``: 10 minutes and 1 hour of six axes at 1 kHz.

The commands are streamed from file to file, so the peak must not grow with their length. The limit
and the time are printed too. The second pair of runs has effects, noise and the table of loads.
``make bench`` runs it; it needs about 5 GB of free disk space.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from importlib import resources
from math import inf
from pathlib import Path

import numpy as np

from rotemina.sim.records import PIECE_ROWS, Record, Tap, write_pieces
from rotemina.sim.robot_files import load_robot

RATE_HZ = 1000
DURATIONS_S = (600, 3600)
LIMIT_MB = 500.0
# Largest ratio of the peaks of the longest and the shortest run.
MAX_GROWTH = 1.1
QUICK = {"DURATIONS_S": (2, 4), "LIMIT_MB": inf, "MAX_GROWTH": inf}

EFFECTS = """
[[axis.thx.effect]]
id = "hysteresis"
[[axis.thy.effect]]
id = "delay"
[[axis.zn.effect]]
id = "flexible_mode"
"""

PROBE = """
import sys
import psutil
from rotemina.app.cli.main import main
def peak_bytes():
    if sys.platform == "win32":
        return psutil.Process().memory_info().peak_wset
    if sys.platform == "darwin":
        import resource
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # Not ru_maxrss, which on Linux begins with the peak of the parent process.
    status = open("/proc/self/status").read()
    return 1024 * int(status.split("VmHWM:")[1].split()[0])
status = main(sys.argv[1:])
print(peak_bytes())
sys.exit(status)
"""


def test_a_long_simulation_stays_within_its_memory_limit() -> None:
    peaks = main()
    assert max(max(pair) for pair in peaks) <= LIMIT_MB
    assert all(long <= MAX_GROWTH * short for short, long in peaks)


def main(*durations_s: int) -> list[tuple[float, float]]:
    """Measure and print; return the peaks of the shortest and the longest run of each pair, MB."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        commands = [make_commands(folder, length) for length in durations_s or DURATIONS_S]
        shipped_file = resources.files("rotemina.resources.robots").joinpath("rotemina.toml")
        robot_file = folder / "own.toml"
        robot_file.write_text(shipped_file.read_text("utf-8") + EFFECTS, "utf-8")
        print(f"six axes at 1 kHz: peak, MB (limit {LIMIT_MB:.0f}); written, MB; s")
        nominal = [measure("nominal", path, "--no-noise") for path in commands]
        options = ("--robot", str(robot_file), "--loads", str(folder / "loads.csv"))
        full = [measure("effects, noise, loads", path, *options) for path in commands]
    return [(nominal[0], nominal[-1]), (full[0], full[-1])]


def make_commands(folder: Path, duration_s: int) -> Path:
    """Write slow waves of all axes in pieces; return the path of the file."""
    path = folder / f"{duration_s}.csv"
    write_pieces(make_waves(duration_s * RATE_HZ + 1), path)
    return path


def make_waves(rows: int) -> Iterator[Record]:
    """Yield the commands in pieces."""
    robot = load_robot("rotemina")
    for first in range(0, rows, PIECE_ROWS):
        time_s = np.arange(first, min(first + PIECE_ROWS, rows)) / RATE_HZ
        signals = {}
        for number, (name, axis) in enumerate(robot.axes.items()):
            wave = 0.5 + 0.3 * np.sin(0.3 * (number + 1) * time_s) * np.minimum(time_s / 10.0, 1.0)
            signals[name, Tap.CMD] = axis.range[0] + axis.span * wave
        yield Record.from_signals(time_s, signals, {n: robot.unit(n) or "m" for n in robot.axes})


def measure(title: str, commands: Path, *options: str) -> float:
    """Simulate in a separate process, print time and memory, and return the peak, MB."""
    output = commands.with_name("record.csv")
    command = [sys.executable, "-c", PROBE, "simulate", str(commands), *options, "-o", str(output)]
    start = time.perf_counter()
    output_text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    seconds = time.perf_counter() - start
    peak_mb = int(output_text.split()[-1]) / 1e6
    print(
        f"{commands.stem:>5} s, {title:22} {peak_mb:5.0f} {output.stat().st_size / 1e6:6.0f} "
        f"{seconds:6.1f}"
    )
    output.unlink()
    return peak_mb


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
