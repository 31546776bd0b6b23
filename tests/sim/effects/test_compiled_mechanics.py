"""What acts on mechanics does the same compiled as it does in plain Python."""

from ctypes import CFUNCTYPE, POINTER, c_double

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Force, Motion, Stage
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.effects.step import address_of
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
COMPILED = CFUNCTYPE(c_double, *[c_double] * 6, POINTER(c_double), POINTER(c_double))
CASES = [
    (effect, formulation)
    for effect in all_effects()[0].values()
    if effect.stage is Stage.MECHANICS
    for formulation in effect.formulations
    if isinstance(formulation.acts, Force | Motion)
]


def test_all_that_is_expected_is_looked_at():
    names = {effect.id for effect, _ in CASES}
    assert {"backlash", "friction", "contact", "cross_coupling", "vibration"} <= names


@pytest.mark.parametrize(
    ("effect", "formulation"), CASES, ids=[f"{e.id}-{f.name}" for e, f in CASES]
)
def test_compiled_is_plain(effect, formulation):
    axis = "thx" if "piezo" in effect.kinds else "x"
    asked = AxisEffect(
        axis=axis,
        id=effect.id,
        formulation=formulation.name,
        from_axis="z" if effect.coupled else None,
        parameters={"static_ratio": 1.5} if formulation.name in ("stribeck", "lugre") else {},
    )
    attached = Attached.of(ROBOT, asked)
    facts, acts = attached.facts, formulation.acts
    numbers = formulation.numbers(attached.values, facts)
    compiled = COMPILED(address_of(acts.step))
    plain_memory, memory = [0.0] * acts.states, np.zeros(max(acts.states, 1))
    h = 0.02 / facts.pace_hz
    a, b = 0.5 * h**2 / facts.mass, h / facts.mass
    chance = np.random.default_rng(5)
    path = facts.low + facts.span * chance.uniform(0.0, 1.0, 400)
    speeds = 1e-3 * facts.span * facts.pace_hz * chance.normal(size=400)
    for row, (x, v) in enumerate(zip(path, speeds, strict=True)):
        state = (float(x), float(v), row * h, h, a, b)
        plain = acts.step(*state, list(numbers), plain_memory)
        pointers = (each.ctypes.data_as(POINTER(c_double)) for each in (numbers, memory))
        assert compiled(*state, *pointers) == pytest.approx(plain, rel=1e-9, abs=1e-15)
    np.testing.assert_allclose(memory[: acts.states], plain_memory, rtol=1e-9, atol=1e-15)
