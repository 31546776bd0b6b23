"""The fit of a stage's map: exact on exact moves, honest about noise, refusing what it must."""

import numpy as np
import pytest

from rotemina.sim.vision.calibration import Demands, fit_stage
from rotemina.sim.vision.errors import CalibrationError

RING = np.array([[x, y] for x in (-1, 0, 1) for y in (-1, 0, 1)], dtype=float) * 30e-6


def hidden(rotation, handedness, skew, sizes):
    """Build the matrix from what it is told as."""
    second = rotation + handedness * (np.pi / 2 + skew)
    return np.array(
        [
            [np.cos(rotation) / sizes[0], np.cos(second) / sizes[1]],
            [np.sin(rotation) / sizes[0], np.sin(second) / sizes[1]],
        ]
    )


@pytest.mark.parametrize("handedness", [1, -1])
@pytest.mark.parametrize("rotation", [-3.0, -0.4, 0.0, 1.2, 3.1])
def test_an_exact_map_is_recovered_in_words_of_optics(rotation, handedness):
    matrix = hidden(rotation, handedness, 0.02, (0.16e-6, 0.17e-6))
    fit = fit_stage(RING, RING @ matrix.T + [3.0, -2.0])
    told = fit.map.geometry
    assert told.pixel_size == pytest.approx((0.16e-6, 0.17e-6), rel=1e-9)
    assert told.rotation == pytest.approx(rotation, abs=1e-9)
    assert told.skew == pytest.approx(0.02, abs=1e-9)
    assert told.handedness == handedness
    assert fit.offset == pytest.approx([3.0, -2.0])


def test_uncertainties_are_those_that_repeated_calibrations_show():
    matrix = hidden(0.5, -1, 0.01, (0.16e-6, 0.16e-6))
    rng = np.random.default_rng(1)
    told = [
        fit_stage(
            RING,
            RING @ matrix.T + 0.1 * rng.standard_normal(RING.shape),
            np.tile(0.01 * np.eye(2), (9, 1, 1)),
        ).map.geometry
        for _ in range(120)
    ]
    for values, doubts in (
        ([t.rotation for t in told], [t.rotation_uncertainty for t in told]),
        ([t.skew for t in told], [t.skew_uncertainty for t in told]),
        ([t.pixel_size[0] for t in told], [t.pixel_size_uncertainty[0] for t in told]),
        ([t.pixel_size[1] for t in told], [t.pixel_size_uncertainty[1] for t in told]),
    ):
        assert np.std(values) == pytest.approx(np.mean(doubts), rel=0.25)


def test_there_and_back_again():
    fit = fit_stage(RING, RING @ hidden(2.0, -1, 0.1, (0.2e-6, 0.16e-6)).T)
    assert fit.map.displacement(fit.map.pixels(RING)) == pytest.approx(RING, abs=1e-15)
    assert fit.map.uncertainty_px(RING[0]) < 1e-6


def test_a_wrong_registration_is_left_out_and_named():
    matrix = hidden(0.3, 1, 0.0, (0.16e-6, 0.16e-6))
    shifts = RING @ matrix.T + 0.05 * np.random.default_rng(2).standard_normal(RING.shape)
    shifts[4] += [70.0, -40.0]
    fit = fit_stage(RING, shifts)
    assert list(np.flatnonzero(~fit.kept)) == [4]
    assert fit.map.geometry.pixel_size[0] == pytest.approx(0.16e-6, rel=1e-3)


def refused(displacements, shifts, **options):
    with pytest.raises(CalibrationError) as refusal:
        fit_stage(displacements, shifts, **options)
    return str(refusal.value)


MATRIX = hidden(0.3, 1, 0.0, (0.16e-6, 0.16e-6))


def test_moves_along_one_line_are_refused():
    line = np.outer(np.linspace(-1, 1, 9), [30e-6, 30e-6])
    assert "do not span the plane" in refused(line, line @ MATRIX.T)
    assert "do not span the plane" in refused(0.0 * RING, 0.0 * RING)


def test_large_residuals_are_refused_with_the_worst_move():
    shifts = RING @ MATRIX.T + 2.0 * np.random.default_rng(3).standard_normal(RING.shape)
    told = refused(RING, shifts, demands=Demands(outliers=1.0))
    assert "px rms" in told
    assert "at most 0.5 px" in told


def test_an_axis_that_does_not_move_the_picture_is_refused():
    assert "same direction" in refused(RING, RING @ np.array([[6e6, 0.0], [0.0, 0.0]]).T)


def test_small_moves_are_refused_for_what_they_cannot_tell():
    small = 0.05 * RING
    noise = 0.3 * np.random.default_rng(4).standard_normal(RING.shape)
    demands = Demands(outliers=0.5)
    assert "pixel size is uncertain by" in refused(small, small @ MATRIX.T + noise, demands=demands)


def test_many_outliers_are_refused():
    shifts = RING @ MATRIX.T
    shifts[[0, 4, 8]] += [[90.0, 5.0], [-80.0, 33.0], [10.0, 60.0]]
    assert "do not fit" in refused(RING, shifts)


@pytest.mark.parametrize(
    ("moves", "shifts", "told"),
    [
        (RING[:4], RING[:4], "at least 5"),
        (RING, RING[:, :1], "shape"),
        (RING, np.full(RING.shape, np.nan), "finite"),
    ],
)
def test_what_is_no_set_of_moves_is_refused(moves, shifts, told):
    assert told in refused(moves, shifts)
