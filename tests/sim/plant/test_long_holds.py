"""Rows that are far apart: as exact as close rows, at little more cost."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant import ChainPoint, Plant, segment_steps, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_robot(axis, effect, **parameters):
    return replace(ROBOT, effects=(AxisEffect(axis=axis, id=effect, parameters=parameters),))


def simulate_reading(robot, axis, interval_s, rows=30):
    axis_model = robot.axes[axis]
    sine = np.sin(2.0 * np.pi * np.arange(rows) / 17.0)
    command = sum(axis_model.range) / 2.0 + min(0.3 * axis_model.span, 2e-3) * sine
    time_s = interval_s * np.arange(rows)
    record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: "m"})
    return simulate_nominal_response(robot, record).signal(axis, Tap.MEAS)


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
def test_long_holds_are_as_exact_as_with_short_steps(axis, effect, parameters, monkeypatch):
    robot = make_robot(axis, effect, **parameters)
    with_growing_steps = simulate_reading(robot, axis, 1.0)
    monkeypatch.setattr(segment_steps, "_find_growth_start", lambda *_: np.inf)
    assert with_growing_steps == pytest.approx(
        simulate_reading(robot, axis, 1.0), abs=1e-4 * 1.2e-8
    )


def test_steps_grow_during_a_hold():
    plant = Plant.of(make_robot("zn", "contact"), only={"zn"})
    parts = [
        int(steps.parts[steps.step].sum())
        for interval_s in (0.1, 10.0)
        for steps in [plant.make_steps(interval_s * np.arange(10), 0, ChainPoint.COMMAND)]
    ]
    assert parts[1] < 10 * parts[0]


def test_steps_of_a_friction_force_do_not_grow():
    plant = Plant.of(make_robot("x", "friction"), only={"x"})
    steps = plant.make_steps(10.0 * np.arange(4), 0, ChainPoint.COMMAND)
    assert steps.length_s.max() <= plant.assembly.inner_step_s
