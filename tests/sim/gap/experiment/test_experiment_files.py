"""Files of a suggested experiment."""

import numpy as np
import pytest

from rotemina.sim.gap.diagnosis import Experiment
from rotemina.sim.gap.experiment.experiment_files import may_be_suggested, suggestion
from rotemina.sim.messages import message
from rotemina.sim.records.record import Tap

TIME_S = (0.0, 0.1, 0.2)
EXPERIMENT = Experiment(
    axis="zn",
    splits=("creep", "hysteresis"),
    why=message("gap", "Wait."),
    time_s=TIME_S,
    commands={"zn": (0.0, 1e-6, 1e-6), "x": (0.02, 0.02, 0.02)},
    predictions={"creep": (0.0, 9e-7, 1e-6), "creep/2": (0.0, 8e-7, 8e-7)},
)
UNITS = {"zn": "m", "x": "m"}


def test_the_commands_are_a_trajectory_and_each_rival_has_its_prediction():
    made = suggestion(EXPERIMENT, 2, "day", UNITS)
    assert made.names.commands == "day_experiment_2.csv"
    trajectory = made.records[made.names.commands]
    assert {column.tap for column in trajectory.columns} == {Tap.CMD}
    assert trajectory.time_s == pytest.approx(np.array(TIME_S))
    for rival, reading in EXPERIMENT.predictions.items():
        record = made.records[made.names.predictions[rival]]
        assert record.signal("zn", Tap.MEAS) == pytest.approx(np.array(reading))
        assert record.signal("zn", Tap.CMD) == pytest.approx(trajectory.signal("zn", Tap.CMD))


def test_names_are_those_of_files_and_of_the_document_alone():
    made = suggestion(EXPERIMENT, 1, "day", UNITS)
    assert set(made.records) == {made.names.commands, *made.names.predictions.values()}
    for name in made.records:
        assert "/" not in name
        assert may_be_suggested(name, "day")
        assert not may_be_suggested(name, "da.")
    assert not may_be_suggested("day_experiment_1.toml", "day")
