"""`gap diagnose`: time and memory as for a user, compared with a simulation of the same records.

Limits, on two cores of an idle machine, for three records of a stage of three axes: 60 s with an
effect on an axis, 5 s without an effect; 2 GB.
"""

import os
import subprocess
import sys
import time
from statistics import median

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

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


def make_commands(number):
    """Return commands of 12 to 20 s: shrinking triangles, a sum of sines, or steps."""
    time_s = np.arange(round((12.0 + 4.0 * number) * RATE_HZ)) / RATE_HZ
    signals, units = {}, {}
    for position, name in enumerate(AXES):
        axis = ROBOT.axes[name]
        phase = time_s * (0.3 + 0.07 * position)
        shape = (
            (2.0 * np.abs(2.0 * (phase % 1.0) - 1.0) - 1.0) * np.exp(-time_s / 10.0),
            0.5 * np.sin(2 * np.pi * phase) + 0.3 * np.sin(2 * np.pi * 5.3 * phase),
            np.sign(np.sin(2 * np.pi * phase)) * (0.3 + 0.04 * np.floor(phase)),
        )[number]
        signals[name, Tap.CMD] = sum(axis.range) / 2 + 0.35 * axis.span * shape
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units)


@pytest.mark.parametrize("case", CASES)
def test_a_diagnosis_next_to_the_simulation_of_its_records(case, tmp_path):
    effects, limit = CASES[case]
    commands = [make_commands(number) for number in range(3)]
    paths = []
    for number, axis_commands in enumerate(commands):
        record = simulate(ROBOT, effects, axis_commands, np.random.default_rng(number))
        paths.append(str(tmp_path / f"train_{number}.csv"))
        write_record(record, paths[-1])
    diagnosis_times_s, peaks_gb, ratios = [], [], []
    for _ in range(TURNS):
        begin = time.perf_counter()
        for axis_commands in commands:
            simulate(ROBOT, effects, axis_commands)
        simulation_s = time.perf_counter() - begin
        begin = time.perf_counter()
        command = [sys.executable, "-m", "rotemina.app.cli.main", "gap", "diagnose", *paths]
        child = subprocess.Popen(
            [*command, "--json", str(tmp_path / "out.json")],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        assert child.returncode == 0
        for output in tmp_path.glob("out*"):
            output.unlink()
        diagnosis_times_s.append(time.perf_counter() - begin)
        ratios.append(diagnosis_times_s[-1] / simulation_s)
        peaks_gb.append(usage.ru_maxrss / 2**20)
    print(
        f"\n{case}, {TURNS} runs: {median(diagnosis_times_s):.1f} s ({min(diagnosis_times_s):.1f} "
        f"to {max(diagnosis_times_s):.1f}; "
        f"limit {limit:.0f}), {median(ratios):.0f} times its simulation, {max(peaks_gb):.2f} GB "
        f"(limit 2)"
    )
