"""Rows that are far apart: as exact as near ones, at little more cost."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant import segment_steps
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.plant.state import Behind
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


def with_effect(axis, effect, **parameters):
    return replace(ROBOT, effects=(AxisEffect(axis=axis, id=effect, parameters=parameters),))


def response(robot, axis, interval_s, rows=30):
    described = robot.axes[axis]
    turn = np.sin(2.0 * np.pi * np.arange(rows) / 17.0)
    command = sum(described.range) / 2.0 + min(0.3 * described.span, 2e-3) * turn
    time_s = interval_s * np.arange(rows)
    record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})
    return nominal_response(robot, record).signal(axis, Tap.MEAS)


@pytest.mark.parametrize(
    ("axis", "effect", "parameters"),
    [
        ("zn", "contact", {"place": 3e-5}),
        ("zn", "slew_limit", {}),
        ("zn", "amplifier_lag", {}),
        ("x", "friction", {}),
        ("x", "sensor_lag", {}),
    ],
)
def test_long_holds_are_as_exact_as_with_short_steps_throughout(
    axis, effect, parameters, monkeypatch
):
    robot = with_effect(axis, effect, **parameters)
    quick = response(robot, axis, 1.0)
    monkeypatch.setattr(segment_steps, "_grows_after", lambda *_: np.inf)
    assert quick == pytest.approx(response(robot, axis, 1.0), abs=1e-4 * 1.2e-8)


def test_steps_grow_with_the_time_in_a_hold():
    plant = Plant.of(with_effect("zn", "contact"), only={"zn"})
    parts = [
        int(made.parts[made.step].sum())
        for interval_s in (0.1, 10.0)
        for made in [plant.steps(interval_s * np.arange(10), 0, Behind.COMMAND)]
    ]
    assert parts[1] < 10 * parts[0]


def test_a_force_that_sticks_keeps_its_steps():
    plant = Plant.of(with_effect("x", "friction"), only={"x"})
    made = plant.steps(10.0 * np.arange(4), 0, Behind.COMMAND)
    assert made.length_s.max() <= plant.assembly.inner_step_s
