"""Regimes of a command: turns, holds, ends and swings."""

import numpy as np
import pytest

from rotemina.sim.gap.location.regimes import Regime, Ways, regimes
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def test_an_error_of_the_screw_shows_by_quarters_of_its_turn():
    own = ROBOT.axes["x"]
    time_s = np.arange(8000) / 1000.0
    command = sum(own.range) / 2 + 4.0 * own.pitch * time_s / 8.0
    turn = Ways.of([command], own)
    assert turn.turn == own.pitch
    found = regimes(time_s, command, np.zeros(8000, dtype=bool), turn)
    quarters = [found[one] for one in Regime if one.value.endswith("of a turn")]
    assert [int(rows.sum()) for rows in quarters] == pytest.approx([2000] * 4, abs=2)
    assert np.sum(quarters, axis=0).max() == 1
    still = Ways.of([command[:10]], own)  # hardly moves: no phase of a turn to speak of
    found = regimes(time_s[:10], command[:10], np.zeros(10, dtype=bool), still)
    assert not any(found[one].any() for one in Regime if one.value.endswith("of a turn"))


def test_ends_of_the_way_and_swings_cover_every_row():
    time_s = np.arange(900) / 1000.0
    command = np.interp(time_s, [0.0, 0.3, 0.5, 0.9], [0.0, 3.0, 2.0, 2.0])
    found = regimes(time_s, command, np.zeros(900, dtype=bool), Ways.of([command]))
    ends = [Regime.LOW_END, Regime.MIDDLE, Regime.HIGH_END]
    assert np.all(np.sum([found[one] for one in ends], axis=0) == 1)
    assert found[Regime.LARGE_SWING][100]
    assert found[Regime.SMALL_SWING][400]
    assert not (found[Regime.SMALL_SWING] | found[Regime.LARGE_SWING])[850]


def test_regimes_of_a_ramp_with_a_turn_and_a_rest():
    time_s = np.arange(1000) / 1000.0
    command = np.interp(time_s, [0.0, 0.3, 0.6, 1.0], [0.0, 1.0, 0.0, 0.0])
    ways = Ways.of([command])
    found = regimes(time_s, command, np.zeros(1000, dtype=bool), ways)
    assert found[Regime.FORWARD][100]
    assert found[Regime.BACKWARD][500]
    assert found[Regime.REVERSAL][310]
    assert not found[Regime.REVERSAL][400]
    assert found[Regime.SETTLING][650]
    assert found[Regime.REST][800]
    other = regimes(time_s, command, np.ones(1000, dtype=bool), ways)
    assert other[Regime.OTHER_AXIS][800]
