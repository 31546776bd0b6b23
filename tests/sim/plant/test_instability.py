"""Effects that cannot be simulated: refused beforehand where it can be told, else with the time."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects import attachment
from rotemina.sim.effects.errors import BrokenEffectError, EffectError
from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Force,
    Formulation,
    LinearPart,
    Parameter,
    Part,
    Stage,
)
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
RATE = Parameter("rate", "of growth", "", 0.0, 1e6, 10.0)


def push(x, other, t, h, a, b, p, s):
    """A force along the speed: the axis is driven on."""
    return p[0] * other


def uncompilable(x, other, t, h, a, b, p, s):
    """What plain Python takes, and compiled code does not."""
    return x + len({"a": x}) * object()


def growing(values, _facts):
    return LinearPart(
        a=np.array([[values["rate"]]]), b=np.array([[1.0, 0.0, 0.0]]), output=np.array([1e-6])
    )


def third_party(acts):
    return Effect(
        id="push",
        title="Push",
        summary="A motion that grows.",
        stage=Stage.MECHANICS,
        kinds=EVERY_KIND,
        formulations=(
            Formulation(
                name="push", equation="f = r v", source="test", parameters=(RATE,), acts=acts
            ),
        ),
    )


@pytest.fixture
def with_effect(monkeypatch):
    def install(acts, **parameters):
        monkeypatch.setattr(attachment, "effect_named", lambda _id: third_party(acts))
        return replace(ROBOT, effects=(AxisEffect(axis="x", id="push", parameters=parameters),))

    return install


def swing():
    time_s = np.arange(4000) / 1000.0
    command = 0.0275 + 1e-3 * np.sin(2 * np.pi * time_s)
    return Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})


def test_states_that_grow_by_themselves_are_refused(with_effect):
    robot = with_effect(Part(part=growing), rate=5.0)
    with pytest.raises(
        EffectError, match=r"axis x: unstable together.*0\.2 s.*push on x.*rate = 5"
    ):
        Plant.of(robot)


def test_a_simulation_that_diverges_tells_when(with_effect):
    robot = with_effect(Force(step=push), rate=1e5)
    with pytest.raises(PlantError, match=r"axis x: .*at t = \d.*push on x"):
        simulate(robot, None, swing())


def test_a_weak_push_against_damping_is_simulated(with_effect):
    robot = with_effect(Force(step=push), rate=100.0)
    record = simulate(robot, None, swing())
    assert np.abs(record.signal("x", Tap.REF) - record.signal("x", Tap.CMD)).max() < 1e-4


def test_a_step_function_that_cannot_be_compiled_is_named_with_the_reason(with_effect):
    robot = with_effect(Force(step=uncompilable))
    with pytest.raises(
        BrokenEffectError,
        match=r"axis\.x\.effect push: formulation 'push': .*cannot be compiled: \w+Error",
    ):
        Plant.of(robot)


def test_numbers_that_cannot_be_made_are_told_with_the_reason(monkeypatch):
    effect = third_party(Force(step=push))
    broken = replace(effect.formulations[0], prepare=lambda values, _facts: (1.0 / values["none"],))
    effect = replace(effect, formulations=(broken,))
    monkeypatch.setattr(attachment, "effect_named", lambda _id: effect)
    robot = replace(ROBOT, effects=(AxisEffect(axis="x", id="push"),))
    with pytest.raises(
        BrokenEffectError, match=r"axis\.x\.effect push: .*cannot be made: KeyError"
    ):
        Plant.of(robot)
