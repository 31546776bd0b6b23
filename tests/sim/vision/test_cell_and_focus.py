"""Cell outlines, the membrane ahead of a tip, and focus."""

import numpy as np
import pytest

from rotemina.sim.microscope.cell import Cell
from rotemina.sim.vision.autofocus import Autofocus, fit_peak, sharpness
from rotemina.sim.vision.cell import CellOutline, find_cell, membrane_ahead
from rotemina.sim.vision.errors import VisionError

AWAY = (5e-3, 0.0, 0.0)
CELL = Cell((5e-6, -4e-6, 0.0), radii_m=(22e-6, 18e-6, 12e-6))


@pytest.mark.parametrize("tip_m", [AWAY, (22e-6, 0.0, 4e-6)])
@pytest.mark.parametrize("off", [(0.0, 0.0), (-15.0, 10.0)])
def test_an_outline_is_found_from_any_place_inside(make_view, tip_m, off):
    view = make_view(cell=CELL)
    middle = view.pixel(CELL.centre_m)
    found = find_cell(view.image(tip_m), middle + off, (20.0, 90.0))
    assert found.centre == pytest.approx(middle, abs=0.5)
    pixel_m = view.optics.pixel_m
    assert found.figures[2:4] == pytest.approx([22e-6 / pixel_m, 18e-6 / pixel_m], abs=2.0)


def test_an_empty_place_has_no_outline(make_view):
    view = make_view()
    with pytest.raises(VisionError, match="absorbs"):
        find_cell(view.image(AWAY), np.array([250.0, 200.0]), (20.0, 90.0))


def circle(radius=50.0, doubt=0.1):
    figures = np.array([100.0, 100.0, radius, radius, 0.0])
    return CellOutline(figures, doubt**2 * np.eye(5), np.zeros((0, 2)), 0.1)


def test_the_membrane_ahead_of_a_circle_is_where_geometry_says():
    found = membrane_ahead(circle(), np.array([200.0, 130.0]), 0.04 * np.eye(2), np.pi)
    half = np.sqrt(50.0**2 - 30.0**2)
    assert found.distance == pytest.approx(100.0 - half)
    assert found.angle == pytest.approx(np.arcsin(30.0 / 50.0))
    assert 0.2 < found.distance_uncertainty < 0.5


def test_inside_the_distance_is_negative_and_away_there_is_no_membrane():
    inside = membrane_ahead(circle(), np.array([100.0, 100.0]), np.eye(2), 0.3)
    assert inside.distance == pytest.approx(-50.0)
    assert inside.angle == pytest.approx(0.0, abs=1e-6)
    assert membrane_ahead(circle(), np.array([200.0, 100.0]), np.eye(2), 0.0) is None
    assert membrane_ahead(circle(), np.array([200.0, 300.0]), np.eye(2), np.pi) is None


def test_sharpness_is_of_detail_and_not_of_noise():
    rng = np.random.default_rng(0)
    noise = 1000.0 + 30.0 * rng.standard_normal((200, 200))
    edges = noise + 200.0 * (np.arange(200) > 100)
    assert abs(sharpness(noise.astype(np.float32))) < 0.05 * sharpness(edges.astype(np.float32))


def test_the_search_for_focus_ends_at_the_sharpest_place():
    rng, search, looks = np.random.default_rng(1), Autofocus.between(-50e-6, 50e-6), 0
    while not search.done:
        away = (search.target - 7.3e-6) / 6e-6
        search = search.with_sharpness(2.0 + 10.0 / (1.0 + away**2) + 0.02 * rng.standard_normal())
        looks += 1
    assert search.peak.place == pytest.approx(7.3e-6, abs=max(3 * search.peak.uncertainty, 1e-7))
    assert search.target == search.peak.place
    assert looks == 16


def test_the_tip_is_brought_into_focus(make_view):
    view, search = make_view(), Autofocus.between(-30e-6, 40e-6)
    column, row = np.rint(view.pixel(np.zeros(3))).astype(int)
    while not search.done:
        image = view.image(np.zeros(3), search.target)
        search = search.with_sharpness(
            sharpness(image[row - 25 : row + 26, column - 25 : column + 26])
        )
    assert abs(search.peak.place) < 4e-6  # a body that climbs is sharpest a little up


@pytest.mark.parametrize(
    ("values", "told"),
    [
        (np.ones(7), "equally sharp"),
        (np.arange(7.0) ** 3, "outside the searched"),
        (np.array([1.0, 2.0, 1.0]), "at least 5"),
    ],
)
def test_a_curve_without_a_peak_is_refused(values, told):
    with pytest.raises(VisionError, match=told):
        fit_peak(np.arange(float(len(values))) * 1e-6, values)


def test_noise_is_no_peak():
    values = np.random.default_rng(2).standard_normal(9)
    with pytest.raises(VisionError, match="focus"):
        fit_peak(np.arange(9.0) * 1e-6, values)


def test_a_range_that_is_none_is_refused():
    with pytest.raises(VisionError, match="is not a range"):
        Autofocus.between(1e-6, 1e-6)
