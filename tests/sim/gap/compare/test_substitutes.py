"""What does much the same as a cause, and with which numbers."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.compare.substitutes import _alike, _loads, substitutes
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect


def test_a_twin_has_the_form_of_its_cause_and_its_numbers():
    cause = AxisEffect(
        axis="x",
        id="static_nonlinearity",
        formulation="series",
        parameters={"begin": 0.2, "end": 0.9, "sine_1": 1e-4, "sine_2": 0.0, "sine_3": 0.0},
    )
    twin = _alike(cause, "sensor_nonlinearity")
    assert (twin.id, twin.formulation) == ("sensor_nonlinearity", "series")
    assert twin.parameters == cause.parameters
    gain = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    assert _alike(gain, "sensor_gain").parameters == {"error": 0.02}


def test_a_twin_whose_bounds_are_closer_begins_at_them():
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x", has=lambda tap: False)
    waves = {"period": 1e-3, "sine": 2e-6, "cosine": -1.4e-5, "sine_2": 0.0, "cosine_2": 0.0}
    cause = AxisEffect(axis="x", id="leadscrew_error", parameters=waves)
    Attached.of(robot, cause)
    (twin,) = substitutes(evidence, cause)
    begun = Attached.of(robot, twin)  # refuses what is beyond
    assert twin.id == "encoder_interpolation"
    assert begun.values["cosine"] == -1e-5
    assert begun.values["sine"] == 2e-6


def test_a_delay_is_a_lag_of_the_third_order_as_well():
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="x", has=lambda tap: True)
    cause = AxisEffect(axis="x", id="delay", parameters={"delay": 4e-4})
    (lag,) = substitutes(evidence, cause)
    values = Attached.of(evidence.robot, lag).values
    late_s = values["time_constant"] * (2.0 * values["damping_ratio"] + values["ratio"])
    assert (lag.id, late_s) == ("amplifier_lag", pytest.approx(4e-4))
    evidence.has = lambda tap: False
    assert [one.id for one in substitutes(evidence, cause)] == ["sensor_lag", "amplifier_lag"]


@pytest.mark.parametrize("off", [-0.03, -0.18])
def test_a_load_that_rings_as_slow_as_a_retuned_resonance(off):
    robot = load_robot("rotemina")
    evidence = SimpleNamespace(robot=robot, axis="x")
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": off})
    (load,) = _loads(evidence, cause)
    own = robot.axes["x"].inertia
    mass = own.mass * load.parameters["mass_ratio"]
    spring = mass * (2.0 * np.pi * load.parameters["frequency"]) ** 2
    stiff = np.array([[own.stiffness + spring, -spring], [-spring, spring]])
    slowest = np.sqrt(eigh(stiff, np.diag([own.mass, mass]), eigvals_only=True)[0])
    assert slowest == pytest.approx((1.0 + off) * np.sqrt(own.stiffness / own.mass), rel=1e-9)


def test_no_load_makes_an_axis_ring_faster():
    cause = AxisEffect(axis="x", id="resonance_mismatch", parameters={"frequency_error": 0.1})
    assert _loads(SimpleNamespace(robot=load_robot("rotemina"), axis="x"), cause) == []
