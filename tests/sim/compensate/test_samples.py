"""The samples of a record that can be used for training, and why a record is refused."""

import numpy as np
import pytest

from rotemina.sim.compensate import read_samples
from rotemina.sim.compensate.samples import check_common_rate, have_one_size
from rotemina.sim.errors import CompensationError
from rotemina.sim.records import Record, Tap

ROWS = 1000
SWING = 32e-6 + 25e-6 * np.sin(np.linspace(0.0, 20.0, ROWS))


def make_record(command=SWING, *, axis="zn", taps=(Tap.CMD, Tap.MEAS), time_s=None, **metadata):
    time_s = np.arange(ROWS) * 1e-3 if time_s is None else time_s
    signals = {(axis, tap): command * (2e6 if tap is Tap.U else 1.0) for tap in taps}
    return Record.from_signals(time_s, signals, {axis: "m"}, metadata)


def test_samples_are_in_si_units(robot):
    samples = read_samples(robot, "zn", make_record())
    assert samples.command == pytest.approx(SWING)
    assert samples.sample_s == pytest.approx(1e-3)
    assert samples.first == 0


def test_in_closed_loop_the_command_is_the_controller_output(robot):
    taps = (Tap.CMD, Tap.U, Tap.MEAS)
    samples = read_samples(robot, "zn", make_record(taps=taps, mode="closed_loop"))
    assert samples.command == pytest.approx(2e6 * SWING * robot.axes["zn"].gain)


def test_rows_of_unknown_history_count_after_the_largest_loop(robot):
    first = read_samples(robot, "zn", make_record(history="unknown")).first
    assert SWING[: first + 1].max() > 56e-6
    assert SWING[: first + 1].min() < 8e-6
    assert first < 300


@pytest.mark.parametrize(
    ("options", "axis", "message"),
    [
        ({}, "x", "axis 'x': robot 'RoTeMiNa' has no such piezo axis; use one of thx, thy, zn"),
        ({"taps": (Tap.CMD,)}, "zn", "needs the columns zn.cmd and zn.meas or zn.ref"),
        ({"mode": "closed_loop"}, "zn", "needs the columns zn.u"),
        ({"command": 1e-2 * SWING}, "zn", "less than 5 % of its range"),
        ({"time_s": np.arange(ROWS) ** 1.01 * 1e-3}, "zn", "needs evenly spaced rows"),
    ],
)
def test_a_record_that_cannot_be_used_is_refused(options, axis, message, robot):
    with pytest.raises(CompensationError, match=message):
        read_samples(robot, axis, make_record(**options), "it.csv")


def test_few_rows_and_different_rates_are_refused(robot):
    with pytest.raises(CompensationError, match="150 rows are too few; 200 are needed"):
        read_samples(robot, "zn", make_record().select_rows(slice(0, 150)))
    slow = make_record(time_s=np.arange(ROWS) * 2e-3)
    with pytest.raises(CompensationError, match="resample them to one rate"):
        check_common_rate(
            [
                read_samples(robot, "zn", one_record, "it.csv")
                for one_record in (make_record(), slow)
            ]
        )
    with pytest.raises(CompensationError, match="no record"):
        check_common_rate([])


def test_swings_of_one_size_are_recognized(robot):
    turn = np.linspace(0.0, 100.0, ROWS)
    equal_swings = 32e-6 + 25e-6 * np.sin(turn)
    fading_swings = 32e-6 + 25e-6 * np.sin(turn) * np.exp(-turn / 50.0)
    assert have_one_size([read_samples(robot, "zn", make_record(equal_swings))])
    assert not have_one_size([read_samples(robot, "zn", make_record(fading_swings))])
