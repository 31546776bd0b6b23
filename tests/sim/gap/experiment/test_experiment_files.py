"""Files of a suggested experiment."""

import numpy as np
import pytest

from rotemina.sim.gap.experiment import is_experiment_file, make_experiment_records
from rotemina.sim.gap.result import SuggestedExperiment
from rotemina.sim.messages import message
from rotemina.sim.records import Tap

TIME_S = (0.0, 0.1, 0.2)
EXPERIMENT = SuggestedExperiment(
    axis="zn",
    splits=("creep", "hysteresis"),
    why=message("gap", "Wait."),
    time_s=TIME_S,
    commands={"zn": (0.0, 1e-6, 1e-6), "x": (0.02, 0.02, 0.02)},
    predictions={"creep": (0.0, 9e-7, 1e-6), "creep/2": (0.0, 8e-7, 8e-7)},
)
UNITS = {"zn": "m", "x": "m"}


def test_the_commands_are_a_trajectory_and_each_rival_has_a_prediction():
    files = make_experiment_records(EXPERIMENT, 2, "day", UNITS)
    assert files.names.commands == "day_experiment_2.csv"
    trajectory = files.records[files.names.commands]
    assert {column.tap for column in trajectory.columns} == {Tap.CMD}
    assert trajectory.time_s == pytest.approx(np.array(TIME_S))
    for rival, reading in EXPERIMENT.predictions.items():
        record = files.records[files.names.predictions[rival]]
        assert record.signal("zn", Tap.MEAS) == pytest.approx(np.array(reading))
        assert record.signal("zn", Tap.CMD) == pytest.approx(trajectory.signal("zn", Tap.CMD))
    assert set(files.records) == {files.names.commands, *files.names.predictions.values()}
    for name in files.records:
        assert "/" not in name
        assert is_experiment_file(name, "day")
        assert not is_experiment_file(name, "da.")
    assert not is_experiment_file("day_experiment_1.toml", "day")
