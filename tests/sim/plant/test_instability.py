"""Effects that cannot be simulated: refused beforehand, or stopped with the time of divergence."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import (
    EVERY_KIND,
    AddedStates,
    Effect,
    EffectParameter,
    EffectStage,
    ForceFunction,
    Formulation,
    LinearPart,
    attachment,
)
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


def make_effect(acts):
    return Effect(
        id="push",
        title="Push",
        summary="A motion that grows.",
        stage=EffectStage.MECHANICS,
        kinds=EVERY_KIND,
        formulations=(
            Formulation(
                name="push", equation="f = r v", source="test", parameters=(RATE,), acts=acts
            ),
        ),
    )


@pytest.fixture
def install_effect(monkeypatch):
    def install(acts, **parameters):
        monkeypatch.setattr(attachment, "load_effect", lambda _id: make_effect(acts))
        return replace(ROBOT, effects=(AxisEffect(axis="x", id="push", parameters=parameters),))

    return install


def make_sine():
    time_s = np.arange(4000) / 1000.0
    command = 0.0275 + 1e-3 * np.sin(2 * np.pi * time_s)
    return Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})


def test_states_that_grow_without_input_are_refused(install_effect):
    robot = install_effect(AddedStates(part=make_growing_part), rate=5.0)
    with pytest.raises(EffectError, match=r"axis x: unstable with.*push on x.*rate = 5.*0\.2 s"):
        Plant.of(robot)


def test_a_simulation_that_diverges_stops_with_its_time(install_effect):
    robot = install_effect(ForceFunction(step=push_along_velocity), rate=1e5)
    with pytest.raises(PlantError, match=r"axis x: .*at t = \d.*push on x"):
        simulate(robot, None, make_sine())


def test_a_weak_push_against_damping_is_simulated(install_effect):
    robot = install_effect(ForceFunction(step=push_along_velocity), rate=100.0)
    record = simulate(robot, None, make_sine())
    assert np.abs(record.signal("x", Tap.REF) - record.signal("x", Tap.CMD)).max() < 1e-4


def test_a_step_function_that_cannot_be_compiled_is_refused_with_the_reason(install_effect):
    robot = install_effect(ForceFunction(step=fail_to_compile))
    with pytest.raises(
        BrokenEffectError,
        match=r"axis\.x\.effect push: formulation 'push': .*cannot be compiled: \w+Error",
    ):
        Plant.of(robot)


def test_an_effect_that_fails_to_prepare_its_numbers_is_refused_with_the_reason(monkeypatch):
    effect = make_effect(ForceFunction(step=push_along_velocity))
    broken_formulation = replace(
        effect.formulations[0], prepare=lambda values, _facts: (1.0 / values["none"],)
    )
    effect = replace(effect, formulations=(broken_formulation,))
    monkeypatch.setattr(attachment, "load_effect", lambda _id: effect)
    robot = replace(ROBOT, effects=(AxisEffect(axis="x", id="push"),))
    with pytest.raises(
        BrokenEffectError, match=r"axis\.x\.effect push: .*cannot be made: KeyError"
    ):
        Plant.of(robot)
