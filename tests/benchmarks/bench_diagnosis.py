"""`gap diagnose`: seconds and memory as a user runs it, beside simulating the same records.

Limits, on two cores and a quiet machine, for three records of a stage of three axes: 60 s with an
effect on an axis, 5 s where nothing is wrong; 2 GB.
"""

import os
import subprocess
import sys
import time
from statistics import median

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ, TURNS = 1000.0, 3
AXES = ("thx", "thy", "zn")
CASES = {
    "healthy": ([], 5.0),
    "one lag": (
        [AxisEffect(axis="zn", id="amplifier_lag", parameters={"time_constant": 2e-3})],
        60.0,
    ),
    "one loop": ([AxisEffect(axis="thx", id="hysteresis")], 60.0),
}
QUICK = {"TURNS": 1, "RATE_HZ": 100.0}


def commands(number):
    """Triangles that shrink, a sum of sines, or steps; 12 to 20 s."""
    time_s = np.arange(round((12.0 + 4.0 * number) * RATE_HZ)) / RATE_HZ
    signals, units = {}, {}
    for place, name in enumerate(AXES):
        axis = ROBOT.axes[name]
        phase = time_s * (0.3 + 0.07 * place)
        shape = (
            (2.0 * np.abs(2.0 * (phase % 1.0) - 1.0) - 1.0) * np.exp(-time_s / 10.0),
            0.5 * np.sin(2 * np.pi * phase) + 0.3 * np.sin(2 * np.pi * 5.3 * phase),
            np.sign(np.sin(2 * np.pi * phase)) * (0.3 + 0.04 * np.floor(phase)),
        )[number]
        signals[name, Tap.CMD] = sum(axis.range) / 2 + 0.35 * axis.span * shape
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units)


@pytest.mark.parametrize("case", CASES)
def test_a_diagnosis_beside_the_simulation_of_its_records(case, tmp_path):
    effects, limit = CASES[case]
    asked = [commands(number) for number in range(3)]
    names = []
    for number, one in enumerate(asked):
        record = simulate(ROBOT, effects, one, np.random.default_rng(number))
        names.append(str(tmp_path / f"train_{number}.csv"))
        write_record(record, names[-1])
    rows, peaks, ratios = [], [], []
    for _ in range(TURNS):
        begin = time.perf_counter()
        for one in asked:
            simulate(ROBOT, effects, one)
        simulated = time.perf_counter() - begin
        begin = time.perf_counter()
        command = [sys.executable, "-m", "rotemina.app.cli.main", "gap", "diagnose", *names]
        child = subprocess.Popen(
            [*command, "--json", str(tmp_path / "out.json")],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        assert child.returncode == 0
        for left in tmp_path.glob("out*"):
            left.unlink()
        rows.append(time.perf_counter() - begin)
        ratios.append(rows[-1] / simulated)
        peaks.append(usage.ru_maxrss / 2**20)
    print(
        f"\n{case}, {TURNS} runs: {median(rows):.1f} s ({min(rows):.1f} to {max(rows):.1f}; "
        f"limit {limit:.0f}), {median(ratios):.0f} times its simulation, {max(peaks):.2f} GB "
        f"(limit 2)"
    )
