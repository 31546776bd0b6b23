"""Regimes of a command: turns, holds, ends and oscillations."""

import numpy as np
import pytest

from rotemina.sim.gap.location import (
    AxisTravel,
    OperatingRegime,
    find_regimes,
)
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def test_an_error_of_the_screw_is_located_by_quarters_of_a_turn():
    axis = ROBOT.axes["x"]
    time_s = np.arange(8000) / 1000.0
    command = sum(axis.range) / 2 + 4.0 * axis.pitch * time_s / 8.0
    travel = AxisTravel.of([command], axis)
    assert travel.turn == axis.pitch
    regimes = find_regimes(time_s, command, np.zeros(8000, dtype=bool), travel)
    quarters = [regimes[regime] for regime in OperatingRegime if regime.value.endswith("of a turn")]
    assert [int(rows.sum()) for rows in quarters] == pytest.approx([2000] * 4, abs=2)
    assert np.sum(quarters, axis=0).max() == 1
    # This motion is too short for phases of a turn.
    short_travel = AxisTravel.of([command[:10]], axis)
    regimes = find_regimes(time_s[:10], command[:10], np.zeros(10, dtype=bool), short_travel)
    assert not any(
        regimes[regime].any() for regime in OperatingRegime if regime.value.endswith("of a turn")
    )


def test_parts_of_the_travel_and_oscillations_cover_the_moving_rows():
    time_s = np.arange(900) / 1000.0
    command = np.interp(time_s, [0.0, 0.3, 0.5, 0.9], [0.0, 3.0, 2.0, 2.0])
    regimes = find_regimes(time_s, command, np.zeros(900, dtype=bool), AxisTravel.of([command]))
    ends = [OperatingRegime.LOW_END, OperatingRegime.MIDDLE, OperatingRegime.HIGH_END]
    assert np.all(np.sum([regimes[regime] for regime in ends], axis=0) == 1)
    assert regimes[OperatingRegime.LARGE_SWING][100]
    assert regimes[OperatingRegime.SMALL_SWING][400]
    assert not (regimes[OperatingRegime.SMALL_SWING] | regimes[OperatingRegime.LARGE_SWING])[850]


def test_regimes_of_a_ramp_with_a_turn_and_a_rest():
    time_s = np.arange(1000) / 1000.0
    command = np.interp(time_s, [0.0, 0.3, 0.6, 1.0], [0.0, 1.0, 0.0, 0.0])
    travel = AxisTravel.of([command])
    regimes = find_regimes(time_s, command, np.zeros(1000, dtype=bool), travel)
    assert regimes[OperatingRegime.FORWARD][100]
    assert regimes[OperatingRegime.BACKWARD][500]
    assert regimes[OperatingRegime.REVERSAL][310]
    assert not regimes[OperatingRegime.REVERSAL][400]
    assert regimes[OperatingRegime.SETTLING][650]
    assert regimes[OperatingRegime.REST][800]
    regimes_with_other_axis = find_regimes(time_s, command, np.ones(1000, dtype=bool), travel)
    assert regimes_with_other_axis[OperatingRegime.OTHER_AXIS][800]
