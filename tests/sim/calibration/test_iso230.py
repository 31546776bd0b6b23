"""ISO 230-2 figures against numbers calculated by hand."""

import itertools

import numpy as np
import pytest

from rotemina.sim.calibration.approaches import find_approaches
from rotemina.sim.calibration.iso230 import compute_positioning
from rotemina.sim.errors import SensorCalibrationError


def test_figures_of_two_targets_match_a_hand_calculation():
    # Target 1: up 1, 3 (mean 2, s √2), down 5, 5 (5, 0). Target 2: up 0, 0, down -1, -3 (-2, √2).
    figures = compute_positioning(np.array([[[1.0, 5.0], [3.0, 5.0]], [[0.0, -1.0], [0.0, -3.0]]]))
    root = np.sqrt(2.0)
    assert figures.reversal == pytest.approx(3.0)
    assert figures.mean_reversal == pytest.approx((-3.0 + 2.0) / 2.0)
    assert figures.repeatability_up == pytest.approx(4.0 * root)
    assert figures.repeatability_down == pytest.approx(4.0 * root)
    # R = max(2 s↑ + 2 s↓ + |B|, 4 s↑, 4 s↓), of target 1: 2√2 + 3
    assert figures.repeatability == pytest.approx(2.0 * root + 3.0)
    assert figures.systematic == pytest.approx(5.0 - -2.0)
    assert figures.mean_bidirectional == pytest.approx(3.5 - -1.0)
    assert figures.accuracy == pytest.approx(5.0 - (-2.0 - 2.0 * root))


def test_a_single_run_or_no_target_is_refused():
    with pytest.raises(SensorCalibrationError, match="approached 1 times"):
        compute_positioning(np.zeros((5, 1, 2)))
    with pytest.raises(SensorCalibrationError, match="shape"):
        compute_positioning(np.zeros((0, 5, 2)))


def _make_staircase(positions, hold=200, move=50):
    parts = [np.full(hold, positions[0])]
    for before, after in itertools.pairwise(positions):
        parts += [np.linspace(before, after, move + 1)[1:], np.full(hold, after)]
    return np.concatenate(parts)


def test_holds_are_found_with_their_approach_direction():
    command = _make_staircase([0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0])
    time_s = np.arange(len(command)) * 1e-3
    approaches = find_approaches(time_s, command)
    assert approaches is not None
    assert approaches.targets.tolist() == [1.0, 2.0]  # the ends were reached from one side only
    # The mean of a signal that rises with time tells when each hold took place.
    means = approaches.compute_means(time_s, np.ones(len(time_s), dtype=bool))
    assert means.shape == (2, 2, 2)
    assert (np.diff(means, axis=1) > 0).all()
    assert (means[:, 0, 0] < means[:, 0, 1]).all()  # up comes first in each cycle


def test_unsound_rows_are_ignored():
    command = _make_staircase([0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0])
    time_s = np.arange(len(command)) * 1e-3
    approaches = find_approaches(time_s, command)
    assert approaches is not None
    sound = np.ones(len(time_s), dtype=bool)
    first_hold = slice(approaches.begins[0, 0, 0], approaches.ends[0, 0, 0])
    signal = np.zeros(len(time_s))
    signal[first_hold] = 9.0
    sound[first_hold] = False
    means = approaches.compute_means(signal, sound)
    assert np.isnan(means[0, 0, 0])
    assert np.nansum(means) == 0.0


def test_a_sweep_has_no_targets():
    time_s = np.arange(1000) * 1e-3
    assert find_approaches(time_s, np.sin(time_s)) is None
