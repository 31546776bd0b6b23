"""Cell outlines, the membrane ahead of a tip, and autofocus."""

import numpy as np
import pytest

from rotemina.sim.errors import VisionError
from rotemina.sim.microscope import SimulatedCell
from rotemina.sim.vision import (
    AutofocusSearch,
    CellOutline,
    find_cell,
    find_membrane_ahead,
    measure_sharpness,
)
from rotemina.sim.vision.autofocus import fit_peak

OUT_OF_VIEW_M = (5e-3, 0.0, 0.0)
CELL = SimulatedCell((5e-6, -4e-6, 0.0), radii_m=(22e-6, 18e-6, 12e-6))


@pytest.mark.parametrize(
    ("tip_m", "start_offset"), [(OUT_OF_VIEW_M, (-15.0, 10.0)), ((22e-6, 0.0, 4e-6), (0.0, 0.0))]
)
def test_an_outline_is_found_from_any_start_inside(make_view, tip_m, start_offset):
    view = make_view(cell=CELL)
    middle = view.project(CELL.centre_m)
    outline = find_cell(view.take_image(tip_m), middle + start_offset, (20.0, 90.0))
    assert outline.centre == pytest.approx(middle, abs=0.5)
    pixel_m = view.optics.pixel_m
    assert outline.parameters[2:4] == pytest.approx([22e-6 / pixel_m, 18e-6 / pixel_m], abs=2.0)


def test_an_empty_image_has_no_outline(make_view):
    view = make_view()
    with pytest.raises(VisionError, match="absorbs"):
        find_cell(view.take_image(OUT_OF_VIEW_M), np.array([250.0, 200.0]), (20.0, 90.0))


def make_circle(radius=50.0, uncertainty_px=0.1):
    parameters = np.array([100.0, 100.0, radius, radius, 0.0])
    return CellOutline(parameters, uncertainty_px**2 * np.eye(5), np.zeros((0, 2)), 0.1)


def test_distance_and_angle_of_the_membrane_of_a_circle_are_exact():
    membrane = find_membrane_ahead(make_circle(), np.array([200.0, 130.0]), 0.04 * np.eye(2), np.pi)
    half_chord = np.sqrt(50.0**2 - 30.0**2)
    assert membrane.distance == pytest.approx(100.0 - half_chord)
    assert membrane.angle == pytest.approx(np.arcsin(30.0 / 50.0))
    assert 0.2 < membrane.distance_uncertainty < 0.5


def test_the_distance_is_negative_inside_and_no_membrane_is_found_elsewhere():
    membrane = find_membrane_ahead(make_circle(), np.array([100.0, 100.0]), np.eye(2), 0.3)
    assert membrane.distance == pytest.approx(-50.0)
    assert membrane.angle == pytest.approx(0.0, abs=1e-6)
    assert find_membrane_ahead(make_circle(), np.array([200.0, 100.0]), np.eye(2), 0.0) is None
    assert find_membrane_ahead(make_circle(), np.array([200.0, 300.0]), np.eye(2), np.pi) is None


def test_sharpness_measures_detail_and_not_noise():
    rng = np.random.default_rng(0)
    noise = 1000.0 + 30.0 * rng.standard_normal((200, 200))
    edges = noise + 200.0 * (np.arange(200) > 100)
    assert abs(measure_sharpness(noise.astype(np.float32))) < 0.05 * measure_sharpness(
        edges.astype(np.float32)
    )


def test_the_focus_search_ends_at_the_sharpest_position():
    rng, search, steps = np.random.default_rng(1), AutofocusSearch.between(-50e-6, 50e-6), 0
    while not search.is_done:
        defocus = (search.target - 7.3e-6) / 6e-6
        search = search.with_sharpness(
            2.0 + 10.0 / (1.0 + defocus**2) + 0.02 * rng.standard_normal()
        )
        steps += 1
    assert search.peak.place == pytest.approx(7.3e-6, abs=max(3 * search.peak.uncertainty, 1e-7))
    assert search.target == search.peak.place
    assert steps == 16


def test_the_tip_is_brought_into_focus(make_view):
    view, search = make_view(), AutofocusSearch.between(-30e-6, 40e-6)
    column, row = np.rint(view.project(np.zeros(3))).astype(int)
    while not search.is_done:
        image = view.take_image(np.zeros(3), search.target)
        search = search.with_sharpness(
            measure_sharpness(image[row - 25 : row + 26, column - 25 : column + 26])
        )
    assert abs(search.peak.place) < 4e-6  # a rising body is sharpest a little higher


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.ones(7), "equally sharp"),
        (np.arange(7.0) ** 3, "outside the searched"),
        (np.array([1.0, 2.0, 1.0]), "at least 5"),
        (np.random.default_rng(2).standard_normal(9), "focus"),
    ],
)
def test_a_curve_without_a_peak_is_refused(values, message):
    with pytest.raises(VisionError, match=message):
        fit_peak(np.arange(float(len(values))) * 1e-6, values)


def test_an_empty_range_is_refused():
    with pytest.raises(VisionError, match="is not a range"):
        AutofocusSearch.between(1e-6, 1e-6)
