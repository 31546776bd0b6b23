"""The shapes of excitations match their definitions."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.excitation import (
    CapabilityShare,
    ChirpExcitation,
    DecayingTriangleExcitation,
    MultisineExcitation,
    SineExcitation,
    StaircaseExcitation,
    StepsExcitation,
    SweepsExcitation,
    TriangleExcitation,
    compute_shortest_duration,
    excite,
    make_trapezoid,
)
from rotemina.sim.excitation.moves import compute_longest_stroke
from rotemina.sim.excitation.multisine import choose_odd_lines
from rotemina.sim.excitation.staircase_steps_prbs import PrbsExcitation
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
UNBOUNDED = load_robot("fsm")  # declares neither speed nor acceleration


def make_commands(kind, axis="m1", robot=UNBOUNDED, rate_hz=1000.0, seed=0):
    """Return the commands (n,) of an excitation."""
    record = excite(robot, {axis: kind}, rate_hz=rate_hz, seed=seed).record
    return record.signal(axis, Tap.CMD)


def find_holds(values):
    """Return level and length in rows of every hold of 3 rows or more."""
    edges = np.flatnonzero(np.diff(values) != 0) + 1
    parts = np.split(values, edges)
    return [(part[0], len(part)) for part in parts if len(part) >= 3]


def test_a_sine_has_its_amplitude_and_frequency():
    values = make_commands(
        SineExcitation(amplitude=2e-6, offset=1e-6, frequency_hz=4.0, duration_s=2.0)
    )
    time_s = np.arange(2001) / 1000
    np.testing.assert_allclose(values, 1e-6 - 2e-6 * np.cos(8 * np.pi * time_s), atol=1e-18)


def test_a_periodic_sine_has_one_spectral_line():
    values = make_commands(
        SineExcitation(amplitude=2e-6, frequency_hz=7.0, duration_s=3.0, periodic=True)
    )
    spectrum = np.abs(np.fft.rfft(values)) / (len(values) / 2)
    assert spectrum[21] == pytest.approx(2e-6)
    assert np.delete(spectrum, 21).max() < 1e-20


def test_an_unbounded_triangle_has_one_slope_and_sharp_corners():
    values = make_commands(TriangleExcitation(amplitude=3e-6, frequency_hz=2.5, duration_s=0.8))
    slopes = np.diff(values) * 1000
    np.testing.assert_allclose(np.abs(slopes), 4 * 3e-6 * 2.5, rtol=1e-9)
    np.testing.assert_array_equal(np.sign(slopes), np.tile(np.repeat([1, -1], 200), 2))


def test_a_bounded_triangle_has_its_amplitude_and_period_and_parabolic_corners():
    values = make_commands(
        TriangleExcitation(amplitude=1e-3, frequency_hz=2.0, duration_s=1.0), "x", ROBOT
    )
    assert np.ptp(values) == pytest.approx(2e-3)
    np.testing.assert_array_equal(values[:501], values[500:])
    # v (T/2 - v/a) = 2 A
    speed = 0.1 * (0.25 - np.sqrt(0.0625 - 4 * 2e-3 / 0.2))
    slopes = np.diff(values) * 1000
    assert np.abs(slopes).max() == pytest.approx(speed)
    cruising = np.abs(np.abs(slopes) / speed - 1) < 1e-9
    assert np.mean(cruising) == pytest.approx((0.25 - 2 * speed / 0.2) / 0.25, abs=0.01)
    accelerations = np.diff(slopes) * 1000
    assert np.abs(accelerations).max() == pytest.approx(0.2)


def test_a_decaying_triangle_loses_the_same_amount_at_every_turn():
    kind = DecayingTriangleExcitation(amplitude=4e-6, frequency_hz=5.0, duration_s=1.0)
    values = make_commands(kind)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(values))) != 0) + 1
    np.testing.assert_allclose(
        values[turns], 4e-6 * np.linspace(1, 0.1, 10) * (-1.0) ** np.arange(10), atol=1e-18
    )
    np.testing.assert_array_equal(np.diff(turns), 100)
    assert values[0] == values[-1] == 0.0
    np.testing.assert_array_equal(make_commands(replace(kind, growing=True)), values[::-1])


@pytest.mark.parametrize(("axis", "robot"), [("m1", UNBOUNDED), ("x", ROBOT)])
def test_a_staircase_holds_evenly_spaced_levels(axis, robot):
    values = make_commands(StaircaseExcitation(amplitude=1e-6, levels=5, hold_s=0.25), axis, robot)
    levels, lengths = zip(*find_holds(values), strict=True)
    middle = sum(robot.axes[axis].range) / 2
    expected = middle + 1e-6 * np.array([-1, -0.5, 0, 0.5, 1, 0.5, 0, -0.5, -1])
    np.testing.assert_allclose(levels, expected, atol=1e-15)
    # The first hold includes the start, the others the last row of the move.
    assert set(lengths) == {251}


def test_a_multisine_has_only_odd_harmonics_and_leaves_some_for_detection():
    kind = MultisineExcitation(low_hz=3.0, high_hz=101.0, period_s=1.0, duration_s=2.0, detection=5)
    values = make_commands(kind)
    period = values[:1000] - values[:1000].mean()
    np.testing.assert_array_equal(values[1000:], values[:1000])
    power = np.abs(np.fft.rfft(period)) ** 2
    lines = np.flatnonzero(power > 1e-18 * power.max())
    allowed = np.arange(3, 102, 2)
    assert set(lines) < set(allowed)
    assert len(lines) == 40  # 50 odd lines, and one of each group of five is left out
    groups = (np.array(sorted(set(allowed) - set(lines))) - 3) // 10
    np.testing.assert_array_equal(groups, np.arange(10))
    np.testing.assert_allclose(power[lines], power[lines][0], rtol=1e-9)


def test_a_slope_shapes_the_lines():
    values = make_commands(MultisineExcitation(low_hz=1.0, high_hz=99.0, detection=0, slope=-1.0))[
        :1000
    ]
    size = np.abs(np.fft.rfft(values))[1:100:2]
    np.testing.assert_allclose(size * np.arange(1, 100, 2), size[0], rtol=1e-9)


@pytest.mark.parametrize("seed", [0, 4])
def test_the_crest_factor_is_reduced(seed):
    kind = MultisineExcitation(offset=0.0, low_hz=1.0, high_hz=200.0)
    values = make_commands(kind, seed=seed)
    crest = np.abs(values).max() / np.sqrt(np.mean(values**2))
    assert crest < 1.8  # random phases give about 3


def test_odd_lines_stay_within_the_band():
    rng = np.random.default_rng(0)
    np.testing.assert_array_equal(choose_odd_lines(2.0, 9.0, 0, rng), [3, 5, 7, 9])
    np.testing.assert_array_equal(choose_odd_lines(0.1, 1.0, 0, rng), [1])
    assert len(choose_odd_lines(2.1, 2.9, 0, rng)) == 0


@pytest.mark.parametrize("spacing", ["linear", "log"])
def test_the_instantaneous_frequency_of_a_chirp_follows_its_spacing(spacing):
    kind = ChirpExcitation(
        amplitude=1e-6, offset=0.0, low_hz=2.0, high_hz=50.0, duration_s=10.0, spacing=spacing
    )
    values = make_commands(kind, rate_hz=20_000.0)
    # Half a period lies between two crossings of the middle.
    row_before = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
    crossing_row = row_before + values[row_before] / (values[row_before] - values[row_before + 1])
    time_s = crossing_row / 20_000.0
    middle_s, frequency_hz = (time_s[1:] + time_s[:-1]) / 2, 0.5 / np.diff(time_s)
    share = middle_s / 10.0
    expected = 2.0 + 48.0 * share if spacing == "linear" else 2.0 * 25.0**share
    np.testing.assert_allclose(frequency_hz, expected, rtol=0.01)
    assert values[0] == pytest.approx(-1e-6)
    assert values[-1] == pytest.approx(-1e-6)


@pytest.mark.parametrize(
    ("order", "axis", "robot"), [(3, "m1", UNBOUNDED), (7, "thx", ROBOT), (9, "m1", UNBOUNDED)]
)
def test_a_prbs_has_the_autocorrelation_of_maximum_length(order, axis, robot):
    kind = PrbsExcitation(amplitude=CapabilityShare(0.05), frequency_hz=200.0, order=order)
    values = make_commands(kind, axis, robot)
    count = 2**order - 1
    ends = values.reshape(count, 5)[:, -1]
    low, high = values.min(), values.max()
    chips = np.where(ends > (low + high) / 2, 1.0, -1.0)
    np.testing.assert_allclose(ends, (low + high) / 2 + chips * (high - low) / 2, rtol=1e-12)
    correlation = np.fft.ifft(np.abs(np.fft.fft(chips)) ** 2).real
    np.testing.assert_allclose(correlation, [count, *[-1.0] * (count - 1)], atol=1e-9)


def test_an_unbounded_prbs_jumps_with_its_clock():
    values = make_commands(PrbsExcitation(amplitude=1e-6, offset=0.0, frequency_hz=250.0, order=5))
    assert len(values) == 31 * 4
    np.testing.assert_allclose(np.abs(values), 1e-6, rtol=1e-12)
    assert np.ptp(values.reshape(31, 4), axis=1).max() == 0.0


@pytest.mark.parametrize(("axis", "robot"), [("m1", UNBOUNDED), ("x", ROBOT)])
def test_sweeps_move_in_both_directions_at_each_speed(axis, robot):
    speeds = (3.1e-5, 0.7e-5)
    values = make_commands(SweepsExcitation(amplitude=4e-6, speeds=speeds, hold_s=0.1), axis, robot)
    slopes = np.diff(values) * 1000
    for speed in speeds:
        for direction in (1.0, -1.0):
            rows = np.abs(slopes / (direction * speed) - 1) < 1e-6
            assert rows.sum() / 1000 * speed == pytest.approx(8e-6, rel=0.05)
    assert len(find_holds(values)) == 5


def test_a_step_is_a_minimum_jerk_move():
    values = make_commands(
        StepsExcitation(amplitude=1e-6, offset=0.0, rise_s=0.1, hold_s=0.5), rate_hz=10_000.0
    )
    share = np.arange(1001) / 1000
    rise = 1e-6 * (10 * share**3 - 15 * share**4 + 6 * share**5)
    np.testing.assert_allclose(values[5000:6001], rise, atol=1e-20)
    levels = [level for level, rows in find_holds(values) if rows > 100]
    np.testing.assert_allclose(levels, [0.0, 1e-6, 0.0, -1e-6, 0.0], atol=1e-20)


@pytest.mark.parametrize(
    ("bounds", "derivative_order"),
    [({"max_speed": 1e-3}, 1), ({"max_acceleration": 0.05}, 2), ({}, 3)],
)
def test_a_step_takes_the_time_of_the_tightest_bound(bounds, derivative_order):
    axis = replace(ROBOT.axes["x"], **{"max_speed": None, "max_acceleration": None, **bounds})
    robot = replace(ROBOT, axes={"x": axis}, couplings=())
    limit = next(iter(bounds.values()), 2.0)
    kind = StepsExcitation(amplitude=1e-3, rise_s=1e-3, hold_s=0.1, jerk=None if bounds else limit)
    values = make_commands(kind, "x", robot, rate_hz=5000.0)
    assert np.abs(
        np.diff(values, n=derivative_order) * 5000.0**derivative_order
    ).max() == pytest.approx(limit, rel=0.03)


@pytest.mark.parametrize("speed", [0.5, 2.0, np.inf])
@pytest.mark.parametrize("acceleration", [4.0, np.inf])
def test_longest_stroke_and_shortest_duration_are_inverse(speed, acceleration):
    for duration in (0.1, 1.0, 3.0):
        stroke = compute_longest_stroke(duration, speed, acceleration)
        if stroke < np.inf:
            assert compute_shortest_duration(stroke, speed, acceleration) == pytest.approx(duration)


def test_a_trapezoid_has_its_acceleration_and_reaches_its_end():
    values = np.concatenate([[1.0], make_trapezoid(1.0, -1.0, 400, 100.0, 1.0)])
    assert values[-1] == -1.0
    acceleration = np.diff(values, n=2) * 1e4
    assert np.abs(acceleration).max() == pytest.approx(1.0, rel=1e-6)
    np.testing.assert_allclose(values + values[::-1], 0.0, atol=1e-12)
