"""The figure of the gap: the samples that count, the offset, and the written form."""

import numpy as np
import pytest

from rotemina.sim.comparison import (
    compute_gap_course,
    compute_gap_figure,
    find_moving_samples,
    format_gap,
)

TIME_S = np.arange(4001) * 1e-3  # rests for 1 s, moves for 1 s, rests for 2 s
COMMAND = np.clip(TIME_S - 1.0, 0.0, 1.0)[:, None] * np.array([[2e-5, 0.0]])


def test_samples_count_in_motion_and_half_a_second_after_it():
    counted = find_moving_samples(TIME_S, COMMAND)
    assert (TIME_S[counted][0], TIME_S[counted][-1]) == pytest.approx((1.0, 2.5))
    assert counted.sum() == 1501


def test_a_machine_at_rest_has_no_gap():
    still = np.zeros_like(COMMAND)
    assert not find_moving_samples(TIME_S, still).any()
    assert compute_gap_figure(find_moving_samples(TIME_S, still), still[:, 0], still[:, 0]) is None
    assert not len(find_moving_samples(np.empty(0), np.empty((0, 2))))


def test_the_gap_is_given_with_and_without_the_offset():
    counted = find_moving_samples(TIME_S, COMMAND)
    wave = 3e-7 * np.sqrt(2.0) * np.sin(2.0 * np.pi * 4.0 * TIME_S)
    model = COMMAND[:, 1]
    resting = np.where(counted, 0.0, 1.0)  # samples that do not count may have any value
    figure = compute_gap_figure(counted, model + 4e-7 + wave + resting, model, model - 1e-6)
    assert figure.rms == pytest.approx(5e-7, rel=1e-3)
    assert figure.without_offset == pytest.approx(3e-7, rel=1e-3)
    assert figure.nominal == pytest.approx(np.hypot(1.4e-6, 3e-7), rel=1e-3)


def test_samples_that_are_no_number_are_left_out():
    model = COMMAND[:, 0].copy()
    model[1500:] = np.nan
    figure = compute_gap_figure(find_moving_samples(TIME_S, COMMAND), COMMAND[:, 0] + 1e-7, model)
    assert figure.rms == pytest.approx(1e-7)
    model[:] = np.nan
    assert compute_gap_figure(find_moving_samples(TIME_S, COMMAND), COMMAND[:, 0], model) is None


def test_the_gap_over_time_is_the_figure_of_each_span():
    rng = np.random.default_rng(1)
    counted = find_moving_samples(TIME_S, COMMAND)
    gap = 1e-6 * rng.standard_normal((len(TIME_S), 2)) * [1.0, 1e-3]
    gap[1700:1900, 1] = np.nan
    ends_s = np.array([0.2, 1.1, 1.75, 1.85, 2.4, 3.9])
    course = compute_gap_course(TIME_S, counted, gap, ends_s, 0.1)
    assert course.shape == (6, 2)
    for end_s, row in zip(ends_s, course, strict=True):
        part = (end_s - 0.1 <= TIME_S) & (end_s >= TIME_S) & counted
        for values, rms in zip(gap.T, row, strict=True):
            figure = compute_gap_figure(part, values, np.zeros(len(TIME_S)))
            assert np.isnan(rms) if figure is None else rms == pytest.approx(figure.rms)
    assert np.isnan(course[[0, 5]]).all()
    assert np.isfinite(course[1:5]).sum() == 7


@pytest.mark.parametrize(
    ("size", "unit", "text"),
    [
        (5.531e-6, "m", "5.53 µm"),
        (9.996e-8, "m", "100 nm"),
        (2.02e-8, "m", "20.2 nm"),
        (3.1e-4, "rad", "310 µrad"),
        (0.0, "m", "0 m"),
        (3.47e-18, "m", "0 nm"),
        (None, "m", "–"),
        (float("nan"), "m", "–"),
    ],
)
def test_a_gap_is_written_with_a_readable_unit(size, unit, text):
    assert format_gap(size, unit) == text
