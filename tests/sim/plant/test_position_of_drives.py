"""Effects on an input get the present position, even between samples and pieces of a run."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects import EffectParameter, EffectStage, InputFunction
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import parse_robot
from rotemina.sim.simulation import SimulatedMachine, simulate

ROBOT = parse_robot(
    "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='stepper'\nrange=[0.0, 1.0]\n"
    "mass=1.0\ndamping=4.0\nstiffness=4000.0\nmax_speed=1.0\n"
)
RATE = 200.0


def subtract_deviation(x, other, t, h, a, b, p, s):
    return x - p[0] * (other - 0.5)


@pytest.fixture
def position_feedback(install_effect):
    """An effect that subtracts a share of the deviation from the middle from the input."""
    install_effect(
        InputFunction(step=subtract_deviation, timed=True),
        EffectParameter("k", "share", "", 0.0, 1.0, 0.5),
        stage=EffectStage.ACTUATOR,
        inner_step_s=lambda values, facts: 1e-4,
    )
    return [AxisEffect(axis="a", id="push")]


def make_record(repeats=1):
    command = 0.5 + 0.2 * np.repeat([0.0, 1.0, -1.0, 0.5], 50)
    time_s = np.arange(200 * repeats) / (RATE * repeats)
    return Record.from_signals(time_s, {("a", Tap.CMD): np.repeat(command, repeats)}, {"a": "m"})


def test_the_effect_gets_the_position_between_samples(position_feedback):
    coarse = simulate(ROBOT, position_feedback, make_record()).signal("a", Tap.REF)
    fine = simulate(ROBOT, position_feedback, make_record(50)).signal("a", Tap.REF)[::50]
    np.testing.assert_allclose(coarse, fine, atol=1e-10)
    # The input x − k (q − 1/2) acts like a spring that is 1.5 times as stiff.
    stiff_robot = replace(ROBOT, axes={"a": replace(ROBOT.axes["a"], stiffness=6000.0)})
    scaled_command = make_record().signal("a", Tap.CMD) / 1.5 + 0.5 / 3.0
    record = Record.from_signals(make_record().time_s, {("a", Tap.CMD): scaled_command}, {"a": "m"})
    exact = simulate(stiff_robot, (), record).signal("a", Tap.REF)
    assert np.abs(coarse - exact)[1:].max() < 0.01  # the force is held for a tenth of a millisecond


def simulate_in_pieces(robot, effects, commands):
    machine = SimulatedMachine(robot, effects, commands)
    positions = [
        machine.follow(commands.select_rows(slice(begin, end))).signal("a", Tap.REF)
        for begin, end in pairwise([0, 1, 2, 30, 55, 120, 200])
    ]
    return np.concatenate(positions)


def test_a_run_in_pieces_equals_the_run_at_once(position_feedback):
    whole = simulate(ROBOT, position_feedback, make_record()).signal("a", Tap.REF)
    np.testing.assert_allclose(
        simulate_in_pieces(ROBOT, position_feedback, make_record()), whole, atol=1e-13
    )


def test_the_position_of_a_static_axis_is_known_where_a_piece_begins():
    axis = replace(ROBOT.axes["a"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={"a": axis})
    effects = [AxisEffect(axis="a", id="backlash", parameters={"width": 0.1})]
    time_s = np.arange(200) / RATE
    command = 0.5 + 0.2 * np.cos(2 * np.pi * time_s)
    record = Record.from_signals(time_s, {("a", Tap.CMD): command}, {"a": "m"})
    whole = simulate(robot, effects, record).signal("a", Tap.REF)
    np.testing.assert_allclose(simulate_in_pieces(robot, effects, record), whole, atol=1e-13)
