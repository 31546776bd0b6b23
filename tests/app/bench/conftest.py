"""A machine whose gap has a known cause, in a folder as the bench reads it."""

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT_TOML = """[robot]
name = "A table"
axes = ["q"]

[axis.q]
kind = "stepper"
range = [0.0, 0.01]
static = true
sensor.kind = "encoder"
sensor.resolution = 1.0e-8
sensor.noise_rms = 2.0e-8
"""
TRUTH_TOML = 'causes = [["backlash"]]\nto_beat = 1e-7\n'


@pytest.fixture(scope="session")
def make_machine():
    """Return a function that writes the folder of a machine with backlash."""

    def make(folder, truth=TRUTH_TOML):
        folder.mkdir(parents=True)
        (folder / "robot.toml").write_text(ROBOT_TOML)
        if truth is not None:
            (folder / "truth.toml").write_text(truth)
        robot = load_robot(folder / "robot.toml")
        backlash = AxisEffect(axis="q", id="backlash", parameters={"width": 2e-5})
        time_s = np.arange(400) / 100.0
        for number, name in enumerate(("train_1", "train_2", "test_1"), start=1):
            command = 5e-3 + 1e-3 * np.sin(7.0 * number * time_s) * np.cos(1.7 * time_s)
            commands = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
            run = simulate(robot, [backlash], commands, np.random.default_rng(number))
            write_record(run, folder / f"{name}.csv")
        return folder

    return make


@pytest.fixture(scope="session")
def machine_folder(make_machine, tmp_path_factory):
    return make_machine(tmp_path_factory.mktemp("machines") / "table")
