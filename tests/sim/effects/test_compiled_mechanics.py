"""Effects on mechanics give the same compiled as in plain Python."""

from ctypes import CFUNCTYPE, POINTER, c_double

import numpy as np
import pytest

from rotemina.sim.effects import (
    AttachedEffect,
    EffectStage,
    ForceFunction,
    PositionFunction,
    compile_step_address,
    load_all_effects,
)
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
COMPILED = CFUNCTYPE(c_double, *[c_double] * 6, POINTER(c_double), POINTER(c_double))
CASES = [
    (effect, formulation)
    for effect in load_all_effects()[0].values()
    if effect.stage is EffectStage.MECHANICS
    for formulation in effect.formulations
    if isinstance(formulation.acts, ForceFunction | PositionFunction)
]


def test_the_expected_effects_are_tested():
    names = {effect.id for effect, _ in CASES}
    assert {"backlash", "friction", "contact", "cross_coupling", "vibration"} <= names


@pytest.mark.parametrize(
    ("effect", "formulation"), CASES, ids=[f"{e.id}-{f.name}" for e, f in CASES]
)
def test_compiled_and_plain_python_agree(effect, formulation):
    axis = "thx" if "piezo" in effect.kinds else "x"
    axis_effect = AxisEffect(
        axis=axis,
        id=effect.id,
        formulation=formulation.name,
        from_axis="z" if effect.coupled else None,
        parameters={"static_ratio": 1.5} if formulation.name in ("stribeck", "lugre") else {},
    )
    attached = AttachedEffect.of(ROBOT, axis_effect)
    properties, acts = attached.facts, formulation.acts
    numbers = formulation.compute_numbers(attached.values, properties)
    compiled = COMPILED(compile_step_address(acts.step))
    plain_memory, memory = [0.0] * acts.states, np.zeros(max(acts.states, 1))
    h = 0.02 / properties.pace_hz
    a, b = 0.5 * h**2 / properties.mass, h / properties.mass
    rng = np.random.default_rng(5)
    path = properties.low + properties.span * rng.uniform(0.0, 1.0, 400)
    speeds = 1e-3 * properties.span * properties.pace_hz * rng.normal(size=400)
    for row, (x, v) in enumerate(zip(path, speeds, strict=True)):
        state = (float(x), float(v), row * h, h, a, b)
        plain = acts.step(*state, list(numbers), plain_memory)
        pointers = (array.ctypes.data_as(POINTER(c_double)) for array in (numbers, memory))
        assert compiled(*state, *pointers) == pytest.approx(plain, rel=1e-9, abs=1e-15)
    np.testing.assert_allclose(memory[: acts.states], plain_memory, rtol=1e-9, atol=1e-15)
