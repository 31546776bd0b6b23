"""ISO 230-2 figures against numbers worked out by hand."""

import itertools

import numpy as np
import pytest

from rotemina.sim.calibration.approaches import approaches
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.iso230 import positioning


def test_figures_of_two_targets_by_hand():
    # Target 1: up 1, 3 (mean 2, s √2), down 5, 5 (5, 0). Target 2: up 0, 0, down -1, -3 (-2, √2).
    found = positioning(np.array([[[1.0, 5.0], [3.0, 5.0]], [[0.0, -1.0], [0.0, -3.0]]]))
    root = np.sqrt(2.0)
    assert found.reversal == pytest.approx(3.0)
    assert found.mean_reversal == pytest.approx((-3.0 + 2.0) / 2.0)
    assert found.repeatability_up == pytest.approx(4.0 * root)
    assert found.repeatability_down == pytest.approx(4.0 * root)
    # R = max(2 s↑ + 2 s↓ + |B|, 4 s↑, 4 s↓), of target 1: 2√2 + 3
    assert found.repeatability == pytest.approx(2.0 * root + 3.0)
    assert found.systematic == pytest.approx(5.0 - -2.0)
    assert found.mean_bidirectional == pytest.approx(3.5 - -1.0)
    assert found.accuracy == pytest.approx(5.0 - (-2.0 - 2.0 * root))


def test_a_shift_of_all_changes_nothing_and_a_scale_all():
    deviations = np.random.default_rng(3).normal(size=(7, 5, 2))
    figures = np.array(positioning(deviations))
    assert np.array(positioning(deviations + 4.0)) == pytest.approx(figures)
    assert np.array(positioning(3.0 * deviations)) == pytest.approx(3.0 * figures)


def test_one_run_has_no_spread():
    with pytest.raises(CalibrationError, match="approached 1 times"):
        positioning(np.zeros((5, 1, 2)))
    with pytest.raises(CalibrationError, match="shape"):
        positioning(np.zeros((0, 5, 2)))


def _staircase(places, hold=200, move=50):
    parts = [np.full(hold, places[0])]
    for before, after in itertools.pairwise(places):
        parts += [np.linspace(before, after, move + 1)[1:], np.full(hold, after)]
    return np.concatenate(parts)


def test_holds_are_found_with_the_side_they_were_reached_from():
    command = _staircase([0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0])
    time_s = np.arange(len(command)) * 1e-3
    found = approaches(time_s, command)
    assert found is not None
    assert found.targets.tolist() == [1.0, 2.0]  # the ends were reached from one side alone
    # Rows show the side: a signal that rises with time has the second hold of each side later.
    means = found.means(time_s, np.ones(len(time_s), dtype=bool))
    assert means.shape == (2, 2, 2)
    assert (np.diff(means, axis=1) > 0).all()
    assert (means[:, 0, 0] < means[:, 0, 1]).all()  # up comes first in each cycle


def test_unsound_rows_count_for_nothing():
    command = _staircase([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0])
    time_s = np.arange(len(command)) * 1e-3
    found = approaches(time_s, command)
    assert found is not None
    sound = np.ones(len(time_s), dtype=bool)
    first = slice(found.rows[0, 0, 0], found.ends[0, 0, 0])
    signal = np.zeros(len(time_s))
    signal[first] = 9.0
    sound[first] = False
    means = found.means(signal, sound)
    assert np.isnan(means[0, 0, 0])
    assert np.nansum(means) == 0.0


def test_a_sweep_has_no_targets():
    time_s = np.arange(1000) * 1e-3
    assert approaches(time_s, np.sin(time_s)) is None
