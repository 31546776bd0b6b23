"""Input shaping and feed-forward against exact answers of a second-order axis."""

import numpy as np
import pytest
from scipy.signal import StateSpace, lsim

from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.feed_forward import inverse_of, led
from rotemina.sim.shaping.impulses import shaped, zero_vibration
from rotemina.sim.shaping.moves import minimum_jerk, s_curve_in, tabled

FREQUENCY_HZ, DAMPING = 420.0, 0.025
RATE = 2 * np.pi * FREQUENCY_HZ


def answered(shape, after_s=0.0, frequency_hz=FREQUENCY_HZ):
    """Return times, position and speed of the axis, 40 times as fine as its period."""
    rate = 2 * np.pi * frequency_hz
    system = StateSpace(
        [[0.0, 1.0], [-(rate**2), -2 * DAMPING * rate]],
        [[0.0], [rate**2]],
        np.eye(2),
        np.zeros((2, 1)),
    )
    time_s = np.arange(0.0, shape.duration_s + after_s, 1 / (40 * FREQUENCY_HZ))
    _, out, _ = lsim(system, shape.position(time_s), time_s)
    return time_s, out


def ringing(shape, frequency_hz=FREQUENCY_HZ):
    """Return the amplitude of what is left when the move has ended."""
    time_s, out = answered(shape, 0.02, frequency_hz)
    first = np.searchsorted(time_s, shape.duration_s)
    x, v = out[first, 0] - shape.length, out[first, 1]
    return np.hypot(x, v / (2 * np.pi * frequency_hz))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_a_shaper_leaves_nothing_of_its_frequency(order):
    shaper = zero_vibration(FREQUENCY_HZ, DAMPING, order)
    assert shaper.amplitudes.sum() == pytest.approx(1.0)
    assert shaper.residual(np.array([FREQUENCY_HZ]), DAMPING)[0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("order", "flat"), [(1, 0), (2, 1), (3, 2)])
def test_each_order_takes_away_one_more_derivative_over_the_frequency(order, flat):
    shaper = zero_vibration(FREQUENCY_HZ, DAMPING, order)
    near = shaper.residual(FREQUENCY_HZ * (1 + np.array([0.01, 0.02])), DAMPING)
    # Doubling the mismatch multiplies what is left by 2^(order).
    assert np.log2(near[1] / near[0]) == pytest.approx(flat + 1, abs=0.05)


def test_a_single_impulse_rings_at_full_strength():
    shaper = zero_vibration(FREQUENCY_HZ, 0.0)
    assert shaper.residual(np.array([1e-6]), 0.0)[0] == pytest.approx(1.0)
    assert zero_vibration(FREQUENCY_HZ, 0.0).amplitudes.tolist() == [0.5, 0.5]


def fast_move():
    """20 mm/s, 80 m/s² and 10⁶ m/s³ at the most: 50 µm in 2.83 ms."""
    return s_curve_in(50e-6, 2.83e-3, ramp=0.33 / 2.83, rounding=0.16 / 0.33)


@pytest.mark.parametrize("order", [1, 2])
def test_a_shaped_fast_move_leaves_no_vibration_and_an_unshaped_one_does(order):
    fast = fast_move()
    calm = shaped(fast, zero_vibration(FREQUENCY_HZ, DAMPING, order))
    assert calm.length == pytest.approx(50e-6, rel=1e-12)
    assert calm.duration_s == pytest.approx(
        fast.duration_s + order * 0.5 / (FREQUENCY_HZ * np.sqrt(1 - DAMPING**2))
    )
    assert ringing(fast) > 1e-6
    assert ringing(calm) < 2e-3 * ringing(fast)


def test_zvd_forgives_a_wrong_frequency_that_zv_does_not():
    fast = fast_move()
    left = [
        ringing(shaped(fast, zero_vibration(FREQUENCY_HZ, DAMPING, order)), 1.05 * FREQUENCY_HZ)
        for order in (1, 2)
    ]
    assert left[1] < 0.15 * left[0]


def test_shaping_is_the_sum_of_shifted_moves_at_every_instant():
    shape = s_curve_in(50e-6, 0.03)
    shaper = zero_vibration(FREQUENCY_HZ, DAMPING, 2)
    time_s = np.linspace(-0.01, 0.05, 601)
    expected = sum(
        a * shape.position(time_s - t)
        for t, a in zip(shaper.times_s, shaper.amplitudes, strict=True)
    )
    np.testing.assert_allclose(shaped(shape, shaper).position(time_s), expected, atol=1e-17)


def test_two_shapers_answer_two_resonances():
    both = zero_vibration(420.0, 0.02).before(zero_vibration(110.0, 0.02))
    assert both.amplitudes.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(both.residual(np.array([110.0, 420.0]), 0.02), 0.0, atol=1e-12)
    twice = zero_vibration(420.0, 0.02).before(zero_vibration(420.0, 0.02))
    np.testing.assert_allclose(twice.amplitudes, zero_vibration(420.0, 0.02, 2).amplitudes)


@pytest.mark.parametrize("bad", [(0.0, 0.1, 1), (420.0, 1.0, 1), (420.0, -0.1, 1), (420.0, 0.1, 0)])
def test_what_is_no_resonance_is_refused(bad):
    with pytest.raises(ShapingError):
        zero_vibration(*bad)


def test_the_inverse_of_the_model_makes_the_axis_follow_the_move_itself():
    wanted = minimum_jerk(50e-6, 0.01)
    commanded = led(wanted, inverse_of(FREQUENCY_HZ, DAMPING))
    time_s, out = answered(commanded)
    np.testing.assert_allclose(out[:, 0], wanted.position(time_s), atol=3e-9)
    assert commanded.length == pytest.approx(wanted.length)
    time_s, out = answered(wanted)
    assert np.abs(out[:, 0] - wanted.position(time_s)).max() > 3e-7


def test_the_inverse_of_a_hold_runs_ahead_by_half_of_it():
    lead = inverse_of(1e9, 0.0, 1e-3)
    assert lead.speed_s == pytest.approx(0.5e-3)
    assert lead.acceleration_s2 == pytest.approx(0.5 * 0.5e-3**2)


def test_a_move_whose_acceleration_jumps_has_no_inverse():
    with pytest.raises(ShapingError, match="acceleration of the profile jumps"):
        led(tabled([0.0, 1.0], [0.0, 1.0]), inverse_of(FREQUENCY_HZ, DAMPING))
