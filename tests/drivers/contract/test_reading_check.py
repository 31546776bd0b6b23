"""Reported positions are used only if they are plausible."""

import pytest
from hypothesis import given, strategies as st

from rotemina.drivers.contract import ReadingBounds, ReadingCheck

BOUNDS = ReadingBounds(0.0, 0.05, 0.01, 1e-6)


@pytest.fixture
def check():
    check = ReadingCheck([BOUNDS, BOUNDS])
    assert check.accept_report((0.01, 0.02), 0.0, 0.01, {0, 1})
    return check


@pytest.mark.parametrize(
    "position",
    [
        (0.01,),
        (0.01, 0.02, 0.0),
        (float("nan"), 0.02),
        (0.01, float("inf")),
        (-2e-6, 0.02),
        (0.01, 0.0500011),
        (0.0112, 0.02),
    ],
)
def test_an_implausible_report_is_discarded_and_counted(check, position):
    assert not check.accept_report(position, 0.1, 0.1, {0, 1})
    assert check.discarded_count == 1
    assert check.is_in_doubt
    assert not check.shows_new_position
    assert check.accept_report((0.011, 0.02), 0.1, 0.11, {0, 1})
    assert not check.is_in_doubt


def test_an_unhomed_axis_may_report_any_position(check):
    assert check.accept_report((7.0, 0.02), 0.1, 0.1, {1})


def test_three_reports_in_a_row_that_agree_show_a_new_position(check):
    for number in range(2):
        assert not check.accept_report((0.04, 0.02), 0.02 * number, 0.02 * number + 0.01, {0, 1})
        assert not check.shows_new_position
    assert not check.accept_report((0.0401, 0.02), 0.04, 0.05, {0, 1})
    assert check.shows_new_position
    check.restart()
    assert check.accept_report((0.0401, 0.02), 0.06, 0.07, {0, 1})


def test_reports_that_contradict_each_other_never_show_a_new_position(check):
    for number in range(9):
        position = (0.03 if number % 2 else 0.045, 0.02)
        assert not check.accept_report(position, 0.02 * number, 0.02 * number + 0.01, {0, 1})
        assert not check.shows_new_position


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=40))
def test_an_accepted_value_is_always_in_range_and_reachable(values):
    check, last_value, accepted_s = ReadingCheck([BOUNDS]), None, 0.0
    for number, value in enumerate(values):
        now_s = 0.5 * number
        if not check.accept_report((value,), now_s, now_s, {0}):
            continue
        assert -1e-6 <= value <= 0.050001
        assert (
            last_value is None
            or abs(value - last_value) <= 0.01 * (now_s - accepted_s) + 1.0000001e-6
        )
        last_value, accepted_s = value, now_s
