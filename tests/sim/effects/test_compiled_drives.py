"""Effects on inputs give the same compiled as in plain Python, and start at rest."""

from ctypes import CFUNCTYPE, POINTER, c_double

import numpy as np
import pytest

from rotemina.sim.effects import (
    AttachedEffect,
    InputFunction,
    compile_step_address,
    load_all_effects,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
COMPILED = CFUNCTYPE(c_double, *[c_double] * 6, POINTER(c_double), POINTER(c_double))
CASES = [
    pytest.param(effect, formulation, id=f"{effect.id}-{formulation.name}")
    for effect in load_all_effects()[0].values()
    for formulation in effect.formulations
    if isinstance(formulation.acts, InputFunction)
]
every_drive = pytest.mark.parametrize(("effect", "formulation"), CASES)


def test_all_formulations_on_inputs_are_tested():
    assert len(CASES) >= 18


def place_on_axis(effect, formulation):
    axis = "thx" if "piezo" in effect.kinds else "x"
    return axis, AxisEffect(axis=axis, id=effect.id, formulation=formulation.name)


@every_drive
def test_compiled_and_plain_python_agree(effect, formulation):
    attached = AttachedEffect.of(ROBOT, place_on_axis(effect, formulation)[1])
    properties, acts = attached.facts, formulation.acts
    numbers = formulation.compute_numbers(attached.values, properties)
    compiled = COMPILED(compile_step_address(acts.step))
    plain_memory, memory = [0.0] * acts.states, np.zeros(max(acts.states, 1))
    rng = np.random.default_rng(5)
    is_electronic = effect.stage == "electronics"
    low, span = (
        (properties.input_low, properties.input_span)
        if is_electronic
        else (properties.low, properties.span)
    )
    for row in range(400):
        h = (1e9, 0.0, 5e-4, 5e-4, 2e-3)[row % 5 if row > 4 else 0] if row != 5 else 0.0
        h = 5e-4 if row > 5 and h == 1e9 else h
        x, other_value = low + span * rng.uniform(0.0, 1.0, 2)
        state = (float(x), float(other_value), row * 5e-3, h, 0.0, 0.0)
        plain = acts.step(*state, list(numbers), plain_memory)
        pointers = (array.ctypes.data_as(POINTER(c_double)) for array in (numbers, memory))
        assert compiled(*state, *pointers) == pytest.approx(plain, rel=1e-9, abs=1e-12 * span)
    np.testing.assert_allclose(memory[: acts.states], plain_memory, rtol=1e-9, atol=1e-12 * span)


@every_drive
def test_a_machine_with_a_constant_command_stays_at_its_start(effect, formulation):
    axis, axis_effect = place_on_axis(effect, formulation)
    if formulation.name == "event":
        pytest.skip("acts by itself")
    axis_model = ROBOT.axes[axis]
    command = np.full(100, axis_model.range[0] + 0.6 * axis_model.span)
    record = Record.from_signals(
        np.arange(100) / 1e3, {(axis, Tap.CMD): command}, {axis: axis_model.unit}
    )
    position = simulate(ROBOT, [axis_effect], record).signal(axis, Tap.REF)
    assert np.ptp(position) < 1e-8 * axis_model.span
