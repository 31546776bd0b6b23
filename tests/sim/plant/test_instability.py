"""Effects that cannot be simulated: refused beforehand, or stopped with the time of divergence."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import AddedStates, EffectParameter, ForceFunction, LinearPart
from rotemina.sim.errors import BrokenEffectError, EffectError, PlantError
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE = EffectParameter("rate", "of growth", "", 0.0, 1e6, 10.0)


def push_along_velocity(x, other, t, h, a, b, p, s):
    """Return a force along the velocity, which accelerates the axis."""
    return p[0] * other


def fail_to_compile(x, other, t, h, a, b, p, s):
    """Step function that is valid in Python but cannot be compiled."""
    return x + len({"a": x}) * object()


def make_growing_part(values, _facts):
    return LinearPart(
        a=np.array([[values["rate"]]]), b=np.array([[1.0, 0.0, 0.0]]), output=np.array([1e-6])
    )


@pytest.fixture
def make_robot(install_effect):
    """Return a function that returns a robot with an effect on x."""

    def make(acts, **fields):
        parameters = {name: fields.pop(name) for name in ("rate",) if name in fields}
        install_effect(acts, RATE, **fields)
        return replace(ROBOT, effects=(AxisEffect(axis="x", id="push", parameters=parameters),))

    return make


def make_sine():
    time_s = np.arange(4000) / 1000.0
    command = 0.0275 + 1e-3 * np.sin(2 * np.pi * time_s)
    return Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})


def test_states_that_grow_without_input_are_refused(make_robot):
    robot = make_robot(AddedStates(part=make_growing_part), rate=5.0)
    with pytest.raises(EffectError, match=r"axis x: unstable with.*push on x.*rate = 5.*0\.2 s"):
        Plant.of(robot)


def test_a_simulation_that_diverges_stops_with_its_time(make_robot):
    robot = make_robot(ForceFunction(step=push_along_velocity), rate=1e5)
    with pytest.raises(PlantError, match=r"axis x: .*at t = \d.*push on x"):
        simulate(robot, None, make_sine())


def test_a_weak_push_against_damping_is_simulated(make_robot):
    robot = make_robot(ForceFunction(step=push_along_velocity), rate=100.0)
    record = simulate(robot, None, make_sine())
    assert np.abs(record.signal("x", Tap.REF) - record.signal("x", Tap.CMD)).max() < 1e-4


def test_a_step_function_that_cannot_be_compiled_is_refused_with_the_reason(make_robot):
    robot = make_robot(ForceFunction(step=fail_to_compile))
    with pytest.raises(
        BrokenEffectError,
        match=r"axis\.x\.effect push: formulation 'push': .*cannot be compiled: \w+Error",
    ):
        Plant.of(robot)


def test_an_effect_that_fails_to_prepare_its_numbers_is_refused_with_the_reason(make_robot):
    robot = make_robot(
        ForceFunction(step=push_along_velocity),
        prepare=lambda values, _facts: (1.0 / values["none"],),
    )
    with pytest.raises(
        BrokenEffectError, match=r"axis\.x\.effect push: .*cannot be made: KeyError"
    ):
        Plant.of(robot)
