"""The impedance law: exact motion, felt dynamics, and the balance of energy with a contact."""

from math import inf, nan, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from rotemina.app.motion.teleoperation.force_feedback import Contact
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.reference import Bounds, ScalingError
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance

DT = 0.005
WIDE = Bounds(-1.0, 1.0, 10.0, 1e3)
KINDS = {
    "no spring": VirtualImpedance(2.0, 5.0, 0.0, 1.0),
    "soft spring": VirtualImpedance(2.0, 5.0, 1e-2, 1.0),
    "underdamped": VirtualImpedance(2.0, 5.0, 80.0, 1.0),
    "critical": VirtualImpedance(2.0, 8.0, 8.0, 1.0),
    "overdamped": VirtualImpedance(0.2, 50.0, 8.0, 1.0),
}


@pytest.mark.parametrize("kind", sorted(KINDS))
@pytest.mark.parametrize("dt", [1e-4, 5e-3, 0.3, 40.0])
def test_the_response_is_that_of_the_matrix_exponential(kind, dt):
    own = KINDS[kind]
    m, d, k = own.mass, own.damping, own.stiffness
    exact = expm(np.array([[0.0, 1.0, 0.0], [-k / m, -d / m, 1.0 / m], [0.0] * 3]) * dt)
    response = own.response(dt)
    assert response[:4] == pytest.approx(exact[:2, :2].ravel(), rel=1e-9, abs=1e-13)
    assert response[4:] == pytest.approx(exact[:2, 2], rel=1e-9, abs=1e-13)


def test_without_a_spring_the_speed_goes_to_its_end_as_the_closed_form_says():
    law = Impedance(WIDE, VirtualImpedance.gliding(0.05, 0.2))
    law.start(0.0, 0.0, 0.0)
    for k in range(1, 101):
        motion = law.step(1.0, DT)
        t = k * DT
        assert motion.velocity == pytest.approx(0.05 * (1.0 - np.exp(-t / 0.2)), rel=1e-12)
        way = 0.05 * (t - 0.2 * (1.0 - np.exp(-t / 0.2)))
        assert motion.position == pytest.approx(way, rel=1e-10)


def test_with_a_spring_it_swings_as_the_closed_form_says_at_any_step():
    law = Impedance(WIDE, VirtualImpedance.sprung(0.01, 2.0, 0.2))
    law.start(0.0, 0.0, 0.0)
    t, rate = 0.0, 2.0 * pi * 2.0
    damped = rate * np.sqrt(1.0 - 0.2**2)
    for dt in (0.005, 0.02, 0.001, 0.137, 0.05, 0.3):
        motion = law.step(1.0, dt)
        t += dt
        swing = np.cos(damped * t) + 0.2 * rate / damped * np.sin(damped * t)
        exact = 0.01 * (1.0 - np.exp(-0.2 * rate * t) * swing)
        assert motion.position == pytest.approx(exact, rel=1e-10)


def test_what_is_felt_is_told():
    glide = VirtualImpedance.gliding(5e-4, 0.3).felt
    assert (glide.terminal_speed, glide.time_constant_s) == pytest.approx((5e-4, 0.3))
    assert glide.natural_frequency_hz is None
    spring = VirtualImpedance.sprung(1e-3, 1.5, 0.4).felt
    assert spring.natural_frequency_hz == pytest.approx(1.5)
    assert (spring.damping_ratio, spring.travel) == pytest.approx((0.4, 1e-3))
    assert spring.time_constant_s == pytest.approx(1.0 / (0.4 * 2.0 * pi * 1.5))
    slow = VirtualImpedance(1.0, 110.0, 1000.0, 1.0).felt  # poles at -10 and -100
    assert slow.time_constant_s == pytest.approx(0.1)


@pytest.mark.parametrize("kind", ["no spring", "underdamped"])
def test_nothing_moves_at_the_start_of_a_balanced_stick(kind):
    law = Impedance(WIDE, KINDS[kind])
    deflection = 0.6 if KINDS[kind].stiffness else 0.0
    law.start(0.3, 0.0, deflection)
    assert law.step(deflection, DT) == (pytest.approx(0.3, abs=1e-15), pytest.approx(0.0))
    if KINDS[kind].stiffness:
        law.rescale(0.1)
        assert law.step(deflection, DT) == (pytest.approx(0.3, abs=1e-15), pytest.approx(0.0))


@pytest.mark.parametrize(
    ("values", "said"),
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
def test_parameters_out_of_bounds_are_refused_with_what_to_do(values, said):
    with pytest.raises(ScalingError, match=said):
        VirtualImpedance(*values)


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_no_alternation_of_forces_accelerates_more_than_is_said(kind):
    own = KINDS[kind]
    slope = np.array([own.response(t).v_of_v for t in np.linspace(0.0, 60.0, 60_001)])
    variation = (slope[0] + np.abs(np.diff(slope)).sum()) / own.mass
    assert own.acceleration_per_force == pytest.approx(variation, rel=1e-3)


def test_a_mechanism_that_could_be_too_abrupt_is_refused_with_a_mass():
    table = Bounds(0.0, 0.08, 0.01, 0.2)
    with pytest.raises(ScalingError, match=r"use a mass of about 10 "):
        Impedance(table, VirtualImpedance(1.0, 1.0, 0.0, 1.0))
    Impedance(table, VirtualImpedance(10.0, 10.0, 0.0, 1.0))
    with pytest.raises(ScalingError, match=r"the axis permits 0\.2"):
        Impedance(table, VirtualImpedance(10.0, 10.0, 0.0, 1.0), Contact(1.0, 0.0, 0.5))


def test_coarse_is_cut_to_the_force_at_which_it_stays_passive():
    table = Bounds(0.0, 0.08, 0.01, 0.2)
    law = Impedance(table, VirtualImpedance(20.0, 10.0, 0.0, 1.0))
    law.start(0.04, 0.0, 0.0)
    law.rescale(10.0)
    law.step(1.0, DT)
    assert law.force == pytest.approx(2.0)


# --- contact --------------------------------------------------------------------------------------


def test_a_contact_is_felt_beyond_its_noise_and_no_stronger_than_its_bound():
    contact = Contact(gain=1e3, noise=1e-5, most=0.2)
    assert contact.force(0.9e-5) == 0.0
    assert contact.force(-1.1e-4) == pytest.approx(-0.1)
    assert contact.force(1.0) == 0.2


def test_a_gain_that_could_give_energy_is_refused_with_the_greatest():
    own = VirtualImpedance(200.0, 300.0, 0.0, 1.0)
    table = Bounds(0.0, 0.08, 0.01, 0.2)
    assert Contact(1.0, 0.0, 0.1).greatest_gain(own) == pytest.approx(300.0 / 0.015)
    Impedance(table, own, Contact(2e4, 0.0, 0.1))
    with pytest.raises(
        ScalingError, match=r"at most 20000 is permitted with a damping of 300 N s/m"
    ):
        Impedance(table, own, Contact(2.1e4, 0.0, 0.1))
    for bad in ((-1.0, 0.0, 1.0), (1.0, nan, 1.0), (1.0, 0.0, 1.0, 0.0)):
        with pytest.raises(ScalingError, match="contact"):
            Contact(*bad)


def energy(law):
    own, (position, velocity) = law.impedance, law.motion
    return 0.5 * own.mass * velocity**2 + 0.5 * own.stiffness * (position - law.rest) ** 2


inputs = st.lists(st.sampled_from([-1.0, -0.4, 0.0, 0.3, 1.0]), min_size=1, max_size=60).map(
    lambda some: [one for one in some for _ in range(7)]
)


@settings(max_examples=150, deadline=None)
@given(inputs, st.sampled_from(sorted(KINDS)), st.booleans())
def test_no_more_energy_is_stored_than_the_stick_put_in(deflections, kind, tight):
    """Also where bounds of range and speed act."""
    own = KINDS[kind]
    most = own.acceleration_per_force * own.force
    bounds = Bounds(-0.02, 0.02, 0.01, most) if tight else WIDE
    law = Impedance(bounds, own)
    law.start(0.0, 0.0, 0.0)
    put_in = 0.0
    for deflection in deflections:
        before = law.motion.position
        law.step(deflection, DT)
        put_in += law.force * (law.motion.position - before)
        assert energy(law) <= put_in + 1e-12


def excess(law, contact, deflections, delay):
    """Return the most energy that is stored beyond what the stick has put in.

    The real one stays at a wall at 0, which is told some samples late; what the wall's spring holds
    at present counts as stored.
    """
    places = [law.motion.position] * (delay + 1)
    put_in, most = 0.0, -inf
    for deflection in deflections:
        law.step(deflection, DT, min(-places[-1 - delay], 0.0))
        places.append(law.motion.position)
        put_in += law.force * (places[-1] - places[-2])
        pressed = contact.force(max(places[-1], 0.0))
        stored = 0.5 * pressed**2 / contact.gain  # gain · (x − noise)²/2
        most = max(most, energy(law) + stored - put_in)
    return most


@settings(max_examples=150, deadline=None)
@given(inputs, st.sampled_from(["no spring", "soft spring", "underdamped"]), st.integers(0, 3))
def test_a_contact_that_is_told_late_gives_no_energy(deflections, kind, delay):
    own = KINDS[kind]
    limits = {"noise": 1e-4, "most": 1e6, "longest_step_s": DT, "delay_s": delay * DT}
    contact = Contact(own.damping / (DT * (delay + 0.5)), **limits)
    law = Impedance(Bounds(-1.0, 1.0, 10.0, 1e7), own, contact)
    law.start(-1e-3, 0.0, 0.0)
    assert excess(law, contact, deflections, delay) <= 1e-12


def test_a_contact_beyond_the_bound_gives_energy():
    own = KINDS["no spring"]
    contact = Contact(own.damping / (DT * 0.5), 0.0, 1e6, longest_step_s=DT, delay_s=0.0)
    law = Impedance(Bounds(-1.0, 1.0, 10.0, 1e7), own, contact)
    law.start(-1e-3, 0.0, 0.0)
    assert excess(law, contact, [1.0] * 200 + [0.0] * 2000, delay=8) > 1e-3
