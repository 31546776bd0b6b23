"""Trajectories that are compensated by inverses."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import (
    Inverse,
    InverseModel,
    compensate_trajectory,
    find_rest,
    sample_at_ticks,
)
from rotemina.sim.errors import CompensationError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
SAMPLE_S = 1e-3
MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=SAMPLE_S,
    origin=0.0,
    command_origin=0.0,
    span=65e-6,
    desired_range=(2e-6, 60e-6),
    command_range=(0.0, 65e-6),
    speed=1.0,
    consequents=np.array([[0.0, 0.9, 0.1]]),
    radii=np.array([0.1]),
    initial=np.zeros(1),
)
PATH = 30e-6 + 15e-6 * np.sin(2.0 * np.pi * 2.0 * SAMPLE_S * np.arange(800))


def make_trajectory(path=PATH, time_s=None, axis="zn"):
    time_s = SAMPLE_S * np.arange(len(path)) if time_s is None else time_s
    return Record.from_signals(time_s, {(axis, Tap.CMD): path}, {axis: "m"}, {"name": "sine"})


def compensate(record, model=MODEL, **options):
    return compensate_trajectory(ROBOT, record, {"zn": (model, "PI")}, **options)


def test_commands_are_those_of_the_inverse_and_the_metadata_name_it():
    compensated = compensate(make_trajectory())
    assert np.array_equal(
        compensated.signal("zn", Tap.CMD), Inverse(MODEL, SAMPLE_S, preview=True).run(PATH)
    )
    assert compensated.metadata == {"name": "sine", "compensation zn": "PI"}


def test_a_lag_is_compensated_by_looking_ahead():
    lagging = replace(MODEL, lag_s=4.0 * SAMPLE_S)
    compensated = compensate(make_trajectory(), lagging).signal("zn", Tap.CMD)
    # Both begin at rest. The first rows differ because the inverse looks ahead.
    without_lag = compensate(make_trajectory()).signal("zn", Tap.CMD)
    assert np.allclose(compensated[200:-4], without_lag[204:], atol=2e-8)
    assert compensated[-1] == pytest.approx(
        compensated[-5], abs=1e-15
    )  # there is no row ahead of the end
    without_preview = compensate(make_trajectory(), lagging, preview=False).signal("zn", Tap.CMD)
    assert np.allclose(without_preview, Inverse(lagging, SAMPLE_S).run(PATH), rtol=0.0, atol=1e-15)


def test_rows_take_effect_at_the_next_tick():
    record = make_trajectory(np.array([1e-6, 2e-6, 5e-6]), np.array([3.0, 3.0025, 3.004]))
    sampled = sample_at_ticks(record, SAMPLE_S)
    assert np.allclose(sampled.time_s, SAMPLE_S * np.arange(5))
    assert sampled.signal("zn", Tap.CMD).tolist() == [1e-6, 1e-6, 1e-6, 2e-6, 5e-6]


@pytest.mark.parametrize("command", [10e-6, 52e-6])
def test_at_rest_an_inverse_gives_the_present_command(command):
    inverse, desired = find_rest(MODEL, SAMPLE_S, command)
    assert inverse.step(desired) == pytest.approx(command, abs=1e-15)


@pytest.mark.parametrize("command", [0.0, 64e-6])
def test_a_command_that_no_position_needs_is_refused(command):
    with pytest.raises(CompensationError, match="move the axis there first"):
        find_rest(MODEL, SAMPLE_S, command)


@pytest.mark.parametrize(
    ("record", "message"),
    [
        (
            make_trajectory(PATH + 16e-6),
            r"lies outside 2 µm to 60 µm, which the inverse was trained",
        ),
        (
            make_trajectory(PATH[:4], np.array([0.0, 1.0, 1.5, 2.5])),
            "row 2 comes 0.5 s after the previous",
        ),
        (make_trajectory(PATH[:1]), "it has only one row"),
        (
            make_trajectory(PATH, axis="x"),
            "the trajectory commands x; it must command this piezo axis",
        ),
        (compensate(make_trajectory()), "is already compensated"),
    ],
)
def test_trajectories_that_cannot_be_compensated_are_refused(record, message):
    with pytest.raises(CompensationError, match=message):
        compensate(record)


def test_a_command_beyond_the_limits_of_the_machine_is_refused():
    steep = replace(MODEL, consequents=np.array([[0.0, 1.5, 0.1]]))
    with pytest.raises(CompensationError, match="the limits of the machine"):
        compensate(make_trajectory(), steep)
