"""What acts on inputs does the same compiled as it does in plain Python, and starts at rest."""

from ctypes import CFUNCTYPE, POINTER, c_double

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Drive
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.effects.step import address_of
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
COMPILED = CFUNCTYPE(c_double, *[c_double] * 6, POINTER(c_double), POINTER(c_double))
CASES = [
    pytest.param(effect, formulation, id=f"{effect.id}-{formulation.name}")
    for effect in all_effects()[0].values()
    for formulation in effect.formulations
    if isinstance(formulation.acts, Drive)
]
every_drive = pytest.mark.parametrize(("effect", "formulation"), CASES)


def test_all_that_is_expected_is_looked_at():
    assert len(CASES) >= 18


def on_axis(effect, formulation):
    axis = "thx" if "piezo" in effect.kinds else "x"
    return axis, AxisEffect(axis=axis, id=effect.id, formulation=formulation.name)


@every_drive
def test_compiled_is_plain(effect, formulation):
    attached = Attached.of(ROBOT, on_axis(effect, formulation)[1])
    facts, acts = attached.facts, formulation.acts
    numbers = formulation.numbers(attached.values, facts)
    compiled = COMPILED(address_of(acts.step))
    plain_memory, memory = [0.0] * acts.states, np.zeros(max(acts.states, 1))
    chance = np.random.default_rng(5)
    electric = effect.stage == "electronics"
    low, span = (facts.input_low, facts.input_span) if electric else (facts.low, facts.span)
    for row in range(400):
        h = (1e9, 0.0, 5e-4, 5e-4, 2e-3)[row % 5 if row > 4 else 0] if row != 5 else 0.0
        h = 5e-4 if row > 5 and h == 1e9 else h
        x, other = low + span * chance.uniform(0.0, 1.0, 2)
        state = (float(x), float(other), row * 5e-3, h, 0.0, 0.0)
        plain = acts.step(*state, list(numbers), plain_memory)
        pointers = (each.ctypes.data_as(POINTER(c_double)) for each in (numbers, memory))
        assert compiled(*state, *pointers) == pytest.approx(plain, rel=1e-9, abs=1e-12 * span)
    np.testing.assert_allclose(memory[: acts.states], plain_memory, rtol=1e-9, atol=1e-12 * span)


@every_drive
def test_a_machine_that_is_left_alone_stays_where_a_run_begins(effect, formulation):
    axis, asked = on_axis(effect, formulation)
    if formulation.name == "event":
        pytest.skip("acts by itself")
    own = ROBOT.axes[axis]
    command = np.full(100, own.range[0] + 0.6 * own.span)
    record = Record.from_signals(np.arange(100) / 1e3, {(axis, Tap.CMD): command}, {axis: own.unit})
    answer = simulate(ROBOT, [asked], record).signal(axis, Tap.REF)
    assert np.ptp(answer) < 1e-8 * own.span
