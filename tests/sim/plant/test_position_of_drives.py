"""What effects on an input know of the position: that of now, between samples and pieces too."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects import attachment
from rotemina.sim.effects.formulation import Drive, Effect, Formulation, Parameter, Stage
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import Simulation, simulate

ROBOT = parse_robot(
    "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='stepper'\nrange=[0.0, 1.0]\n"
    "mass=1.0\ndamping=4.0\nstiffness=4000.0\nmax_speed=1.0\n"
)
RATE = 200.0


def pulled(x, other, t, h, a, b, p, s):
    return x - p[0] * (other - 0.5)


@pytest.fixture
def pull(monkeypatch):
    """An effect that draws the input back by what the position is off its middle."""
    formulation = Formulation(
        name="one",
        equation="y = x − k (q − 1/2)",
        source="none",
        parameters=(Parameter("k", "share", "", 0.0, 1.0, 0.5),),
        acts=Drive(step=pulled, timed=True),
        inner_step_s=lambda values, facts: 1e-4,
    )
    effect = Effect(
        id="pull",
        title="Pull",
        summary="None",
        stage=Stage.ACTUATOR,
        kinds=frozenset({"stepper"}),
        formulations=(formulation,),
    )
    monkeypatch.setattr(attachment, "effect_named", lambda name: effect)
    return [AxisEffect(axis="a", id="pull")]


def driven(often=1):
    command = 0.5 + 0.2 * np.repeat([0.0, 1.0, -1.0, 0.5], 50)
    time_s = np.arange(200 * often) / (RATE * often)
    return Record.from_signals(time_s, {("a", Tap.CMD): np.repeat(command, often)}, {"a": "m"})


def test_between_samples_it_is_the_position_then(pull):
    coarse = simulate(ROBOT, pull, driven()).signal("a", Tap.REF)
    fine = simulate(ROBOT, pull, driven(50)).signal("a", Tap.REF)[::50]
    np.testing.assert_allclose(coarse, fine, atol=1e-10)
    # A spring that is half as stiff again: the input asks for x − k (q − 1/2).
    stiff = replace(ROBOT, axes={"a": replace(ROBOT.axes["a"], stiffness=6000.0)})
    softer = driven().signal("a", Tap.CMD) / 1.5 + 0.5 / 3.0
    record = Record.from_signals(driven().time_s, {("a", Tap.CMD): softer}, {"a": "m"})
    exact = simulate(stiff, (), record).signal("a", Tap.REF)
    assert np.abs(coarse - exact)[1:].max() < 0.01  # the force is held for a tenth of a millisecond


def in_pieces(robot, effects, commands):
    pieces = Simulation(robot, effects, commands)
    joined = [
        pieces.follow(commands.part(slice(begin, end))).signal("a", Tap.REF)
        for begin, end in pairwise([0, 1, 2, 30, 55, 120, 200])
    ]
    return np.concatenate(joined)


def test_a_run_in_pieces_is_the_run_at_once(pull):
    whole = simulate(ROBOT, pull, driven()).signal("a", Tap.REF)
    np.testing.assert_allclose(in_pieces(ROBOT, pull, driven()), whole, atol=1e-13)


def test_a_static_axis_is_not_seen_at_zero_where_a_piece_begins():
    axis = replace(ROBOT.axes["a"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={"a": axis})
    effects = [AxisEffect(axis="a", id="backlash", parameters={"width": 0.1})]
    time_s = np.arange(200) / RATE
    command = 0.5 + 0.2 * np.cos(2 * np.pi * time_s)
    record = Record.from_signals(time_s, {("a", Tap.CMD): command}, {"a": "m"})
    whole = simulate(robot, effects, record).signal("a", Tap.REF)
    np.testing.assert_allclose(in_pieces(robot, effects, record), whole, atol=1e-13)
