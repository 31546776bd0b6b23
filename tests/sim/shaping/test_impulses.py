"""Input shaping and feed-forward, compared with exact responses of a second-order axis."""

import numpy as np
import pytest
from scipy.signal import StateSpace, lsim

from rotemina.sim.errors import ShapingError
from rotemina.sim.shaping import (
    apply_lead,
    apply_shaper,
    interpolate_table,
    invert_axis,
    make_minimum_jerk,
    make_s_curve,
    make_zero_vibration_shaper,
)

FREQUENCY_HZ, DAMPING = 420.0, 0.025
RATE = 2 * np.pi * FREQUENCY_HZ


def simulate_axis(shape, after_s=0.0, frequency_hz=FREQUENCY_HZ):
    """Return times (n,), and position and speed (n, 2) of the axis, at 40 samples per period."""
    rate = 2 * np.pi * frequency_hz
    system = StateSpace(
        [[0.0, 1.0], [-(rate**2), -2 * DAMPING * rate]],
        [[0.0], [rate**2]],
        np.eye(2),
        np.zeros((2, 1)),
    )
    time_s = np.arange(0.0, shape.duration_s + after_s, 1 / (40 * FREQUENCY_HZ))
    _, states, _ = lsim(system, shape.position(time_s), time_s)
    return time_s, states


def measure_ringing(shape, frequency_hz=FREQUENCY_HZ):
    """Return the amplitude of the vibration after the end of the move."""
    time_s, states = simulate_axis(shape, 0.02, frequency_hz)
    end_row = np.searchsorted(time_s, shape.duration_s)
    x, v = states[end_row, 0] - shape.length, states[end_row, 1]
    return np.hypot(x, v / (2 * np.pi * frequency_hz))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_a_shaper_leaves_no_vibration_at_its_frequency_and_little_near_it(order):
    shaper = make_zero_vibration_shaper(FREQUENCY_HZ, DAMPING, order)
    assert shaper.amplitudes.sum() == pytest.approx(1.0)
    residuals = shaper.residual_vibration(FREQUENCY_HZ * np.array([1.0, 1.01, 1.02]), DAMPING)
    assert residuals[0] == pytest.approx(0.0, abs=1e-12)
    # Each order makes one more derivative zero, so twice the mismatch leaves 2^order times as much.
    assert np.log2(residuals[2] / residuals[1]) == pytest.approx(order, abs=0.05)


def test_the_residual_vibration_is_one_far_below_the_frequency():
    shaper = make_zero_vibration_shaper(FREQUENCY_HZ, 0.0)
    assert shaper.residual_vibration(np.array([1e-6]), 0.0)[0] == pytest.approx(1.0)
    assert make_zero_vibration_shaper(FREQUENCY_HZ, 0.0).amplitudes.tolist() == [0.5, 0.5]


def make_fast_move():
    """Return a move of 50 µm in 2.83 ms, up to 20 mm/s, 80 m/s² and 10⁶ m/s³."""
    return make_s_curve(50e-6, 2.83e-3, ramp=0.33 / 2.83, rounding=0.16 / 0.33)


@pytest.mark.parametrize("order", [1, 2])
def test_only_an_unshaped_fast_move_leaves_vibration(order):
    unshaped = make_fast_move()
    shaped = apply_shaper(unshaped, make_zero_vibration_shaper(FREQUENCY_HZ, DAMPING, order))
    assert shaped.length == pytest.approx(50e-6, rel=1e-12)
    assert shaped.duration_s == pytest.approx(
        unshaped.duration_s + order * 0.5 / (FREQUENCY_HZ * np.sqrt(1 - DAMPING**2))
    )
    assert measure_ringing(unshaped) > 1e-6
    assert measure_ringing(shaped) < 2e-3 * measure_ringing(unshaped)


def test_zvd_is_more_robust_to_a_wrong_frequency_than_zv():
    move = make_fast_move()
    amplitudes = [
        measure_ringing(
            apply_shaper(move, make_zero_vibration_shaper(FREQUENCY_HZ, DAMPING, order)),
            1.05 * FREQUENCY_HZ,
        )
        for order in (1, 2)
    ]
    assert amplitudes[1] < 0.15 * amplitudes[0]


def test_a_shaped_move_is_the_sum_of_shifted_moves():
    shape = make_s_curve(50e-6, 0.03)
    shaper = make_zero_vibration_shaper(FREQUENCY_HZ, DAMPING, 2)
    time_s = np.linspace(-0.01, 0.05, 601)
    expected = sum(
        a * shape.position(time_s - t)
        for t, a in zip(shaper.times_s, shaper.amplitudes, strict=True)
    )
    np.testing.assert_allclose(apply_shaper(shape, shaper).position(time_s), expected, atol=1e-17)


def test_combined_shapers_suppress_two_resonances():
    combined = make_zero_vibration_shaper(420.0, 0.02).combine_with(
        make_zero_vibration_shaper(110.0, 0.02)
    )
    assert combined.amplitudes.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(
        combined.residual_vibration(np.array([110.0, 420.0]), 0.02), 0.0, atol=1e-12
    )
    repeated = make_zero_vibration_shaper(420.0, 0.02).combine_with(
        make_zero_vibration_shaper(420.0, 0.02)
    )
    np.testing.assert_allclose(
        repeated.amplitudes, make_zero_vibration_shaper(420.0, 0.02, 2).amplitudes
    )


@pytest.mark.parametrize(
    "arguments", [(0.0, 0.1, 1), (420.0, 1.0, 1), (420.0, -0.1, 1), (420.0, 0.1, 0)]
)
def test_invalid_resonances_are_refused(arguments):
    with pytest.raises(ShapingError):
        make_zero_vibration_shaper(*arguments)


def test_with_the_inverse_of_the_model_the_axis_follows_the_move():
    move = make_minimum_jerk(50e-6, 0.01)
    commanded = apply_lead(move, invert_axis(FREQUENCY_HZ, DAMPING))
    time_s, states = simulate_axis(commanded)
    np.testing.assert_allclose(states[:, 0], move.position(time_s), atol=3e-9)
    assert commanded.length == pytest.approx(move.length)
    time_s, states = simulate_axis(move)
    assert np.abs(states[:, 0] - move.position(time_s)).max() > 3e-7


def test_the_inverse_of_a_hold_leads_by_half_of_it():
    lead = invert_axis(1e9, 0.0, 1e-3)
    assert lead.speed_s == pytest.approx(0.5e-3)
    assert lead.acceleration_s2 == pytest.approx(0.5 * 0.5e-3**2)


def test_a_move_whose_acceleration_jumps_has_no_inverse():
    with pytest.raises(ShapingError, match="acceleration of the profile jumps"):
        apply_lead(interpolate_table([0.0, 1.0], [0.0, 1.0]), invert_axis(FREQUENCY_HZ, DAMPING))
