"""Which positions that a device reports may be used."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.drivers.reading_check import ReadingBounds, ReadingCheck

BOUNDS = ReadingBounds(0.0, 0.05, 0.01, 1e-6)


@pytest.fixture
def check():
    made = ReadingCheck([BOUNDS, BOUNDS])
    assert made.accepts((0.01, 0.02), 0.0, 0.01, {0, 1})
    return made


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
def test_an_incomplete_distant_or_quick_report_is_discarded_and_counted(check, position):
    assert not check.accepts(position, 0.1, 0.1, {0, 1})
    assert check.discarded == 1
    assert check.is_in_doubt
    assert not check.shows_new_position
    assert check.accepts((0.011, 0.02), 0.1, 0.11, {0, 1})
    assert not check.is_in_doubt


def test_an_axis_whose_position_is_unknown_may_read_anything(check):
    assert check.accepts((7.0, 0.02), 0.1, 0.1, {1})


def test_three_reports_in_a_row_that_agree_are_a_new_position(check):
    for number in range(2):
        assert not check.accepts((0.04, 0.02), 0.02 * number, 0.02 * number + 0.01, {0, 1})
        assert not check.shows_new_position
    assert not check.accepts((0.0401, 0.02), 0.04, 0.05, {0, 1})
    assert check.shows_new_position
    check.restart()
    assert check.accepts((0.0401, 0.02), 0.06, 0.07, {0, 1})


def test_reports_that_contradict_each_other_never_are_a_new_position(check):
    for number in range(9):
        position = (0.03 if number % 2 else 0.045, 0.02)
        assert not check.accepts(position, 0.02 * number, 0.02 * number + 0.01, {0, 1})
        assert not check.shows_new_position


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=40))
def test_what_is_accepted_is_always_inside_and_was_within_reach(values):
    check, last, taken_s = ReadingCheck([BOUNDS]), None, 0.0
    for number, value in enumerate(values):
        now_s = 0.5 * number
        if not check.accepts((value,), now_s, now_s, {0}):
            continue
        assert -1e-6 <= value <= 0.050001
        assert last is None or abs(value - last) <= 0.01 * (now_s - taken_s) + 1.0000001e-6
        last, taken_s = value, now_s
