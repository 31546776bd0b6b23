"""Trajectories sent through inverses."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Inverse, resting_at
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.trajectory import compensated, on_ticks
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
H = 1e-3
MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=H,
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
PATH = 30e-6 + 15e-6 * np.sin(2.0 * np.pi * 2.0 * H * np.arange(800))


def trajectory(path=PATH, time_s=None, axis="zn"):
    time_s = H * np.arange(len(path)) if time_s is None else time_s
    return Record.from_signals(time_s, {(axis, Tap.CMD): path}, {axis: "m"}, {"name": "sine"})


def sent(record, model=MODEL, **options):
    return compensated(ROBOT, record, {"zn": (model, "PI")}, **options)


def test_commands_are_the_inverse_s_and_say_so():
    found = sent(trajectory())
    assert np.array_equal(found.signal("zn", Tap.CMD), Inverse(MODEL, H, preview=True).run(PATH))
    assert found.metadata == {"name": "sine", "compensation zn": "PI"}


def test_a_lag_is_made_up_for_by_looking_ahead():
    late = replace(MODEL, lag_s=4.0 * H)
    found = sent(trajectory(), late).signal("zn", Tap.CMD)
    # Both begin at rest: the first rows differ by what is ahead of them.
    plain = sent(trajectory()).signal("zn", Tap.CMD)
    assert np.allclose(found[200:-4], plain[204:], atol=2e-8)
    assert found[-1] == pytest.approx(found[-5], abs=1e-15)  # nothing is ahead of the end
    blind = sent(trajectory(), late, preview=False).signal("zn", Tap.CMD)
    assert np.allclose(blind, Inverse(late, H).run(PATH), rtol=0.0, atol=1e-15)


def test_rows_are_held_until_the_tick_that_follows():
    rows = trajectory(np.array([1e-6, 2e-6, 5e-6]), np.array([3.0, 3.0025, 3.004]))
    held = on_ticks(rows, H)
    assert np.allclose(held.time_s, H * np.arange(5))
    assert held.signal("zn", Tap.CMD).tolist() == [1e-6, 1e-6, 1e-6, 2e-6, 5e-6]


@pytest.mark.parametrize("command", [10e-6, 30e-6, 52e-6])
def test_at_rest_an_inverse_asks_for_the_command_that_was_given(command):
    inverse, desired = resting_at(MODEL, H, command)
    assert inverse.step(desired) == pytest.approx(command, abs=1e-15)


@pytest.mark.parametrize("command", [0.0, 64e-6])
def test_a_command_that_it_never_asks_for_is_refused(command):
    with pytest.raises(CompensationError, match="move the axis there first"):
        resting_at(MODEL, H, command)


@pytest.mark.parametrize(
    ("record", "message"),
    [
        (trajectory(PATH + 16e-6), r"lies outside 2 µm to 60 µm, which the inverse was trained"),
        (
            trajectory(PATH[:4], np.array([0.0, 1.0, 1.5, 2.5])),
            "row 2 comes 0.5 s after the previous",
        ),
        (trajectory(PATH[:1]), "it has only one row"),
        (trajectory(PATH, axis="x"), "the trajectory commands x; it must command this piezo axis"),
        (sent(trajectory()), "is already compensated"),
    ],
)
def test_what_cannot_be_compensated_is_refused(record, message):
    with pytest.raises(CompensationError, match=message):
        sent(record)


def test_a_command_beyond_the_machine_is_refused():
    steep = replace(MODEL, consequents=np.array([[0.0, 1.5, 0.1]]))
    with pytest.raises(CompensationError, match="the limits of the machine"):
        sent(trajectory(), steep)
