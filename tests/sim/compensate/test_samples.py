"""What of a record can be used, and why not."""

import numpy as np
import pytest

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.samples import common, one_size, samples_of
from rotemina.sim.records.record import Record, Tap

ROWS = 1000
SWING = 32e-6 + 25e-6 * np.sin(np.linspace(0.0, 20.0, ROWS))


def record(command=SWING, *, axis="zn", taps=(Tap.CMD, Tap.MEAS), time_s=None, **metadata):
    time_s = np.arange(ROWS) * 1e-3 if time_s is None else time_s
    signals = {(axis, tap): command * (2e6 if tap is Tap.U else 1.0) for tap in taps}
    return Record.from_signals(time_s, signals, {axis: "m"}, metadata)


def test_command_and_position_in_si(robot):
    found = samples_of(robot, "zn", record())
    assert found.command == pytest.approx(SWING)
    assert found.sample_s == pytest.approx(1e-3)
    assert found.first == 0


def test_in_closed_loop_the_command_is_what_the_controller_put_out(robot):
    taps = (Tap.CMD, Tap.U, Tap.MEAS)
    found = samples_of(robot, "zn", record(taps=taps, mode="closed_loop"))
    assert found.command == pytest.approx(2e6 * SWING * robot.axes["zn"].gain)


def test_an_unknown_past_counts_until_the_greatest_loop_is_run_through(robot):
    first = samples_of(robot, "zn", record(history="unknown")).first
    assert SWING[: first + 1].max() > 56e-6
    assert SWING[: first + 1].min() < 8e-6
    assert first < 300


@pytest.mark.parametrize(
    ("made", "axis", "message"),
    [
        ({}, "x", "axis 'x': robot 'RoTeMiNa' has no such piezo axis; use one of thx, thy, zn"),
        ({"taps": (Tap.CMD,)}, "zn", "needs the columns zn.cmd and zn.meas or zn.ref"),
        ({"mode": "closed_loop"}, "zn", "needs the columns zn.u"),
        ({"command": 1e-2 * SWING}, "zn", "less than 5 % of its range"),
        ({"time_s": np.arange(ROWS) ** 1.01 * 1e-3}, "zn", "needs evenly spaced rows"),
    ],
)
def test_a_record_that_cannot_be_used_is_refused(made, axis, message, robot):
    with pytest.raises(CompensationError, match=message):
        samples_of(robot, axis, record(**made), "it.csv")


def test_few_rows_and_different_rates_are_refused(robot):
    with pytest.raises(CompensationError, match="150 rows are too few; 200 are needed"):
        samples_of(robot, "zn", record().part(slice(0, 150)))
    slow = record(time_s=np.arange(ROWS) * 2e-3)
    with pytest.raises(CompensationError, match="resample them to one rate"):
        common([samples_of(robot, "zn", each, "it.csv") for each in (record(), slow)])
    with pytest.raises(CompensationError, match="no record"):
        common([])


def test_swings_of_one_size_are_known_from_others(robot):
    turn = np.linspace(0.0, 100.0, ROWS)
    same = 32e-6 + 25e-6 * np.sin(turn)
    fading = 32e-6 + 25e-6 * np.sin(turn) * np.exp(-turn / 50.0)
    assert one_size([samples_of(robot, "zn", record(same))])
    assert not one_size([samples_of(robot, "zn", record(fading))])
