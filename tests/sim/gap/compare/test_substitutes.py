"""Substitutes, which act almost like a cause, and their parameters."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.gap.compare.substitutes import _alike, _loads, substitutes
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot


def test_a_substitute_has_the_formulation_and_the_parameters_of_its_cause():
    cause = AxisEffect(
        axis="x",
        id="static_nonlinearity",
        formulation="series",
        parameters={"begin": 0.2, "end": 0.9, "sine_1": 1e-4, "sine_2": 0.0, "sine_3": 0.0},
    )
    substitute = _alike(cause, "sensor_nonlinearity")
    assert (substitute.id, substitute.formulation) == ("sensor_nonlinearity", "series")
    assert substitute.parameters == cause.parameters
    gain = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    assert _alike(gain, "sensor_gain").parameters == {"error": 0.02}


def test_a_substitute_with_narrower_bounds_starts_at_them():
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x", has=lambda tap: False)
    parameters = {"period": 1e-3, "sine": 2e-6, "cosine": -1.4e-5, "sine_2": 0.0, "cosine_2": 0.0}
    cause = AxisEffect(axis="x", id="leadscrew_error", parameters=parameters)
    AttachedEffect.of(robot, cause)
    (substitute,) = substitutes(evidence, cause)
    # This would reject a value outside the bounds.
    attached = AttachedEffect.of(robot, substitute)
    assert substitute.id == "encoder_interpolation"
    assert attached.values["cosine"] == -1e-5
    assert attached.values["sine"] == 2e-6


def test_a_delay_has_a_lag_of_third_order_as_substitute():
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="x", has=lambda tap: True)
    cause = AxisEffect(axis="x", id="delay", parameters={"delay": 4e-4})
    (lag,) = substitutes(evidence, cause)
    values = AttachedEffect.of(evidence.robot, lag).values
    delay_s = values["time_constant"] * (2.0 * values["damping_ratio"] + values["ratio"])
    assert (lag.id, delay_s) == ("amplifier_lag", pytest.approx(4e-4))
    evidence.has = lambda tap: False
    assert [substitute.id for substitute in substitutes(evidence, cause)] == [
        "sensor_lag",
        "amplifier_lag",
    ]


@pytest.mark.parametrize("error", [-0.03, -0.18])
def test_a_load_has_the_frequency_of_a_retuned_resonance(error):
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x")
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": error})
    (load,) = _loads(evidence, cause)
    axis = robot.axes["x"].inertia
    mass = axis.mass * load.parameters["mass_ratio"]
    spring = mass * (2.0 * np.pi * load.parameters["frequency"]) ** 2
    stiffness = np.array([[axis.stiffness + spring, -spring], [-spring, spring]])
    slowest_rad_s = np.sqrt(eigh(stiffness, np.diag([axis.mass, mass]), eigvals_only=True)[0])
    assert slowest_rad_s == pytest.approx(
        (1.0 + error) * np.sqrt(axis.stiffness / axis.mass), rel=1e-9
    )


def test_no_load_raises_the_resonance_of_an_axis():
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": 0.1})
    assert _loads(SimpleNamespace(robot=load_robot("rotemina"), axis="x"), cause) == []
