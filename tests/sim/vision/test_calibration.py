"""The fit of a stage map: exact for exact moves, with correct uncertainties, and refusals."""

import numpy as np
import pytest

from rotemina.sim.errors import StageCalibrationError
from rotemina.sim.vision import fit_stage
from rotemina.sim.vision.calibration import CalibrationRequirements

GRID = np.array([[x, y] for x in (-1, 0, 1) for y in (-1, 0, 1)], dtype=float) * 30e-6


def make_matrix(rotation, handedness, skew, pixel_sizes):
    """Return the matrix of a stage map from its geometry."""
    y_direction = rotation + handedness * (np.pi / 2 + skew)
    return np.array(
        [
            [np.cos(rotation) / pixel_sizes[0], np.cos(y_direction) / pixel_sizes[1]],
            [np.sin(rotation) / pixel_sizes[0], np.sin(y_direction) / pixel_sizes[1]],
        ]
    )


@pytest.mark.parametrize(("rotation", "handedness"), [(-3.0, 1), (-0.4, -1), (0.0, 1), (3.1, -1)])
def test_the_geometry_of_an_exact_map_is_recovered(rotation, handedness):
    matrix = make_matrix(rotation, handedness, 0.02, (0.16e-6, 0.17e-6))
    fit = fit_stage(GRID, GRID @ matrix.T + [3.0, -2.0])
    geometry = fit.map.geometry
    assert geometry.pixel_size == pytest.approx((0.16e-6, 0.17e-6), rel=1e-9)
    assert geometry.rotation == pytest.approx(rotation, abs=1e-9)
    assert geometry.skew == pytest.approx(0.02, abs=1e-9)
    assert geometry.handedness == handedness
    assert fit.offset == pytest.approx([3.0, -2.0])


def test_uncertainties_match_the_spread_of_repeated_calibrations():
    matrix = make_matrix(0.5, -1, 0.01, (0.16e-6, 0.16e-6))
    rng = np.random.default_rng(1)
    geometries = [
        fit_stage(
            GRID,
            GRID @ matrix.T + 0.1 * rng.standard_normal(GRID.shape),
            np.tile(0.01 * np.eye(2), (9, 1, 1)),
        ).map.geometry
        for _ in range(120)
    ]
    for name in ("rotation", "skew", "pixel_size"):
        spread = np.std([getattr(geometry, name) for geometry in geometries], axis=0)
        uncertainty = np.mean([getattr(g, f"{name}_uncertainty") for g in geometries], axis=0)
        assert spread == pytest.approx(uncertainty, rel=0.25)


def test_displacements_are_restored_from_shifts():
    fit = fit_stage(GRID, GRID @ make_matrix(2.0, -1, 0.1, (0.2e-6, 0.16e-6)).T)
    assert fit.map.displacement_of(fit.map.shift_of(GRID)) == pytest.approx(GRID, abs=1e-15)
    assert fit.map.uncertainty_px(GRID[0]) < 1e-6


def test_a_wrong_registration_is_an_outlier():
    matrix = make_matrix(0.3, 1, 0.0, (0.16e-6, 0.16e-6))
    shifts = GRID @ matrix.T + 0.05 * np.random.default_rng(2).standard_normal(GRID.shape)
    shifts[4] += [70.0, -40.0]
    fit = fit_stage(GRID, shifts)
    assert list(np.flatnonzero(~fit.inliers)) == [4]
    assert fit.map.geometry.pixel_size[0] == pytest.approx(0.16e-6, rel=1e-3)


def get_refusal(displacements, shifts, **options):
    with pytest.raises(StageCalibrationError) as refusal:
        fit_stage(displacements, shifts, **options)
    return str(refusal.value)


MATRIX = make_matrix(0.3, 1, 0.0, (0.16e-6, 0.16e-6))


def test_large_residuals_are_refused_with_the_worst_move():
    shifts = GRID @ MATRIX.T + 2.0 * np.random.default_rng(3).standard_normal(GRID.shape)
    message = get_refusal(GRID, shifts, requirements=CalibrationRequirements(outliers=1.0))
    assert "px rms" in message
    assert "at most 0.5 px" in message


def test_small_moves_are_refused_for_their_uncertainty():
    moves = 0.05 * GRID
    noise = 0.3 * np.random.default_rng(4).standard_normal(GRID.shape)
    requirements = CalibrationRequirements(outliers=0.5)
    assert "pixel size is uncertain by" in get_refusal(
        moves, moves @ MATRIX.T + noise, requirements=requirements
    )


LINE = np.outer(np.linspace(-1, 1, 9), [30e-6, 30e-6])
OUTLIERS = np.zeros((9, 2))
OUTLIERS[[0, 4, 8]] = [[90.0, 5.0], [-80.0, 33.0], [10.0, 60.0]]


@pytest.mark.parametrize(
    ("moves", "shifts", "message"),
    [
        (GRID[:4], GRID[:4], "at least 5"),
        (GRID, GRID[:, :1], "shape"),
        (GRID, np.full(GRID.shape, np.nan), "finite"),
        (LINE, LINE @ MATRIX.T, "do not span the plane"),
        (0.0 * GRID, 0.0 * GRID, "do not span the plane"),
        (GRID, GRID @ np.array([[6e6, 0.0], [0.0, 0.0]]), "same direction"),
        (GRID, GRID @ MATRIX.T + OUTLIERS, "do not fit"),
    ],
)
def test_moves_that_determine_no_map_are_refused(moves, shifts, message):
    assert message in get_refusal(moves, shifts)
