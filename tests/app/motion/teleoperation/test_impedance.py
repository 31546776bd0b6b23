"""Impedance law: exact motion, perceived dynamics, and the energy balance with a contact."""

from math import inf, nan, pi

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.linalg import expm

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation import ImpedanceLaw
from rotemina.app.motion.teleoperation.force_feedback import ContactFeedback
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance

DT = 0.005
WIDE = CoordinateBounds(-1.0, 1.0, 10.0, 1e3)
KINDS = {
    "no spring": VirtualImpedance(2.0, 5.0, 0.0, 1.0),
    "soft spring": VirtualImpedance(2.0, 5.0, 1e-2, 1.0),
    "underdamped": VirtualImpedance(2.0, 5.0, 80.0, 1.0),
    "critical": VirtualImpedance(2.0, 8.0, 8.0, 1.0),
    "overdamped": VirtualImpedance(0.2, 50.0, 8.0, 1.0),
}


@pytest.mark.parametrize("kind", sorted(KINDS))
@pytest.mark.parametrize("dt", [1e-4, 5e-3, 40.0])
def test_the_response_equals_the_matrix_exponential(kind, dt):
    impedance = KINDS[kind]
    m, d, k = impedance.mass, impedance.damping, impedance.stiffness
    exact = expm(np.array([[0.0, 1.0, 0.0], [-k / m, -d / m, 1.0 / m], [0.0] * 3]) * dt)
    response = impedance.compute_response(dt)
    assert response[:4] == pytest.approx(exact[:2, :2].ravel(), rel=1e-9, abs=1e-13)
    assert response[4:] == pytest.approx(exact[:2, 2], rel=1e-9, abs=1e-13)


def test_with_a_spring_the_motion_follows_the_closed_form_at_any_step():
    law = ImpedanceLaw(WIDE, VirtualImpedance.make_sprung(0.01, 2.0, 0.2))
    law.start(0.0, 0.0, 0.0)
    t, rate = 0.0, 2.0 * pi * 2.0
    damped = rate * np.sqrt(1.0 - 0.2**2)
    for dt in (0.005, 0.02, 0.001, 0.137, 0.05, 0.3):
        motion = law.step(1.0, dt)
        t += dt
        swing = np.cos(damped * t) + 0.2 * rate / damped * np.sin(damped * t)
        exact = 0.01 * (1.0 - np.exp(-0.2 * rate * t) * swing)
        assert motion.position == pytest.approx(exact, rel=1e-10)


def test_the_perceived_dynamics_are_reported():
    gliding = VirtualImpedance.make_gliding(5e-4, 0.3).perceived_dynamics
    assert (gliding.terminal_speed, gliding.time_constant_s) == pytest.approx((5e-4, 0.3))
    assert gliding.natural_frequency_hz is None
    sprung = VirtualImpedance.make_sprung(1e-3, 1.5, 0.4).perceived_dynamics
    assert sprung.natural_frequency_hz == pytest.approx(1.5)
    assert (sprung.damping_ratio, sprung.travel) == pytest.approx((0.4, 1e-3))
    assert sprung.time_constant_s == pytest.approx(1.0 / (0.4 * 2.0 * pi * 1.5))
    slow = VirtualImpedance(1.0, 110.0, 1000.0, 1.0).perceived_dynamics  # poles at -10 and -100
    assert slow.time_constant_s == pytest.approx(0.1)


@pytest.mark.parametrize(("kind", "deflection"), [("no spring", 0.0), ("underdamped", 0.6)])
def test_a_balanced_stick_causes_no_motion_at_the_start(kind, deflection):
    law = ImpedanceLaw(WIDE, KINDS[kind])
    law.start(0.3, 0.0, deflection)
    for factor in (1.0, 0.1):
        law.rescale(factor)
        assert law.step(deflection, DT) == (pytest.approx(0.3, abs=1e-15), pytest.approx(0.0))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((0.0, 1.0, 1.0, 1.0), "mass 0"),
        ((1.0, 0.0, 1.0, 1.0), "damping 0"),
        ((1.0, 1.0, -1.0, 1.0), "stiffness -1"),
        ((1.0, 1.0, 0.0, nan), "force nan"),
        ((inf, 1.0, 0.0, 1.0), "mass inf"),
        ((1.0, 1.0, 1e-6, 1.0), "use 0 for no spring"),
        ((1.0, 0.1, 1.0, 1.0), "use a damping of 0.2 or more"),
    ],
)
def test_parameters_out_of_bounds_are_refused_with_advice(values, message):
    with pytest.raises(ScalingError, match=message):
        VirtualImpedance(*values)


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_no_alternation_of_forces_exceeds_the_stated_acceleration(kind):
    impedance = KINDS[kind]
    slope = np.array([impedance.compute_response(t).v_of_v for t in np.linspace(0.0, 60.0, 60_001)])
    variation = (slope[0] + np.abs(np.diff(slope)).sum()) / impedance.mass
    assert impedance.max_acceleration_per_force == pytest.approx(variation, rel=1e-3)


def test_a_mechanism_that_could_be_too_abrupt_is_refused_with_advice():
    table = CoordinateBounds(0.0, 0.08, 0.01, 0.2)
    with pytest.raises(ScalingError, match=r"use a mass of about 10 "):
        ImpedanceLaw(table, VirtualImpedance(1.0, 1.0, 0.0, 1.0))
    ImpedanceLaw(table, VirtualImpedance(10.0, 10.0, 0.0, 1.0))
    with pytest.raises(ScalingError, match=r"the axis permits 0\.2"):
        ImpedanceLaw(table, VirtualImpedance(10.0, 10.0, 0.0, 1.0), ContactFeedback(1.0, 0.0, 0.5))


# Contact


def test_the_contact_force_starts_above_noise_and_ends_at_its_bound():
    contact = ContactFeedback(gain=1e3, noise=1e-5, max_force=0.2)
    assert contact.compute_force(0.9e-5) == 0.0
    assert contact.compute_force(-1.1e-4) == pytest.approx(-0.1)
    assert contact.compute_force(1.0) == 0.2


def test_a_gain_that_could_add_energy_is_refused_with_the_largest_allowed():
    impedance = VirtualImpedance(200.0, 300.0, 0.0, 1.0)
    table = CoordinateBounds(0.0, 0.08, 0.01, 0.2)
    assert ContactFeedback(1.0, 0.0, 0.1).compute_max_gain(impedance) == pytest.approx(
        300.0 / 0.015
    )
    ImpedanceLaw(table, impedance, ContactFeedback(2e4, 0.0, 0.1))
    with pytest.raises(
        ScalingError, match=r"at most 20000 is permitted with a damping of 300 N s/m"
    ):
        ImpedanceLaw(table, impedance, ContactFeedback(2.1e4, 0.0, 0.1))
    for bad in ((-1.0, 0.0, 1.0), (1.0, nan, 1.0), (1.0, 0.0, 1.0, 0.0)):
        with pytest.raises(ScalingError, match="contact"):
            ContactFeedback(*bad)


def compute_energy(law):
    impedance, (position, velocity) = law.impedance, law.motion
    return (
        0.5 * impedance.mass * velocity**2
        + 0.5 * impedance.stiffness * (position - law.spring_rest) ** 2
    )


DEFLECTIONS = st.lists(st.sampled_from([-1.0, -0.4, 0.0, 0.3, 1.0]), min_size=1, max_size=60).map(
    lambda values: [value for value in values for _ in range(7)]
)


@settings(max_examples=150, deadline=None)
@given(DEFLECTIONS, st.sampled_from(sorted(KINDS)), st.booleans())
def test_stored_energy_never_exceeds_the_input_of_the_stick(deflections, kind, has_tight_bounds):
    """This also holds where bounds of range and speed act."""
    impedance = KINDS[kind]
    max_acceleration = impedance.max_acceleration_per_force * impedance.force
    bounds = CoordinateBounds(-0.02, 0.02, 0.01, max_acceleration) if has_tight_bounds else WIDE
    law = ImpedanceLaw(bounds, impedance)
    law.start(0.0, 0.0, 0.0)
    input_energy = 0.0
    for deflection in deflections:
        previous_position = law.motion.position
        law.step(deflection, DT)
        input_energy += law.force * (law.motion.position - previous_position)
        assert compute_energy(law) <= input_energy + 1e-12


def compute_excess_energy(law, contact, deflections, delay):
    """Return the maximum of the stored energy minus the input of the stick.

    The real axis stays at a wall at 0, which is reported some samples late. The energy in the
    spring of the wall counts as stored.
    """
    positions = [law.motion.position] * (delay + 1)
    input_energy, max_excess = 0.0, -inf
    for deflection in deflections:
        law.step(deflection, DT, min(-positions[-1 - delay], 0.0))
        positions.append(law.motion.position)
        input_energy += law.force * (positions[-1] - positions[-2])
        wall_force = contact.compute_force(max(positions[-1], 0.0))
        wall_energy = 0.5 * wall_force**2 / contact.gain  # gain · (x − noise)²/2
        max_excess = max(max_excess, compute_energy(law) + wall_energy - input_energy)
    return max_excess


@settings(max_examples=150, deadline=None)
@given(DEFLECTIONS, st.sampled_from(["no spring", "soft spring", "underdamped"]), st.integers(0, 3))
def test_a_delayed_contact_adds_no_energy(deflections, kind, delay):
    impedance = KINDS[kind]
    limits = {"noise": 1e-4, "max_force": 1e6, "max_step_s": DT, "delay_s": delay * DT}
    contact = ContactFeedback(impedance.damping / (DT * (delay + 0.5)), **limits)
    law = ImpedanceLaw(CoordinateBounds(-1.0, 1.0, 10.0, 1e7), impedance, contact)
    law.start(-1e-3, 0.0, 0.0)
    assert compute_excess_energy(law, contact, deflections, delay) <= 1e-12
