"""Tip finding: position and depth of the tip, refusals, and tracking."""

from dataclasses import replace
from math import erf

import numpy as np
import pytest

from rotemina.sim.errors import VisionError
from rotemina.sim.microscope import (
    UNTOUCHED_CELL_STATE,
    SimulatedCell,
    TaperedPin,
    advance_cell_state,
)
from rotemina.sim.vision import (
    Pipette,
    begin_track,
    divide_by_background,
    find_tip,
    fit_from_depths,
    fit_tip,
    follow_tip,
    to_grey,
)


def measure_errors(view, focus_m, count=12):
    """Return errors of position (n, 2), px, and depth (n,), m, of fits that start nearby."""
    position_errors, depth_errors = [], []
    for _ in range(count):
        tip_m = view.draw_tip_position()
        true_pixel, depth = view.project(tip_m), -focus_m
        start = true_pixel + view.rng.uniform(-1.0, 1.0, 2)
        fit = fit_tip(view.take_image(tip_m, focus_m), view.pipette, start, 0.8 * depth)
        assert fit is not None
        position_errors.append(fit.pixel - true_pixel)
        depth_errors.append(fit.depth.distance - depth)
    return np.array(position_errors), np.array(depth_errors)


@pytest.mark.parametrize("focus_m", [0.0, -3e-6, 6e-6])
def test_the_tip_is_found_within_a_fifth_of_a_pixel(view, focus_m):
    position_errors, _ = measure_errors(view, focus_m)
    assert np.sqrt((position_errors**2).sum(axis=1).mean()) < 0.2


@pytest.mark.parametrize("focus_m", [4e-6, -10e-6])
def test_the_depth_from_blur_is_within_its_uncertainty(view, focus_m):
    tip_m = view.draw_tip_position()
    fit = fit_tip(
        view.take_image(tip_m, focus_m), view.pipette, view.project(tip_m), -0.7 * focus_m
    )
    assert abs(fit.depth.distance + focus_m) < 3.0 * fit.depth.uncertainty
    assert fit.depth.uncertainty < 0.2 * abs(focus_m)


@pytest.mark.parametrize("focus_m", [6e-6, -6e-6])
def test_a_rising_body_determines_the_sign_of_the_depth(view, focus_m):
    tip_m = np.zeros(3)
    fit = fit_from_depths(
        view.take_image(tip_m, focus_m), view.pipette, view.project(tip_m), (0.0, 8e-6)
    )
    assert fit.depth.sign_known
    assert np.sign(fit.depth.distance) == -np.sign(focus_m)


def test_a_flat_body_does_not_determine_the_sign_of_the_depth(make_view):
    view = make_view(pin=TaperedPin(approach_rad=0.01))
    pipette = replace(view.pipette, depth_per_px=0.0)
    tip_m = np.zeros(3)
    fit = fit_from_depths(view.take_image(tip_m, 6e-6), pipette, view.project(tip_m), (4e-6,))
    assert not fit.depth.sign_known
    assert fit.depth.distance == pytest.approx(6e-6, abs=1e-6)


@pytest.mark.parametrize("direction_error", [0.0, -0.1])
def test_the_tip_is_found_in_a_whole_image_with_its_direction(make_view, direction_error):
    view = make_view(direction_error)
    tip_m = view.draw_tip_position()
    fit = find_tip(view.take_image(tip_m, 2e-6), view.pipette)
    assert np.linalg.norm(fit.pixel - view.project(tip_m)) < 0.3
    assert fit.direction == pytest.approx(view.pipette.direction - direction_error, abs=0.01)


def test_an_image_without_a_tip_is_refused(view):
    with pytest.raises(VisionError, match="nothing in the picture matches it"):
        find_tip(view.take_image([5e-3, 0.0, 0.0]), view.pipette)


def test_an_upright_pin_is_refused():
    with pytest.raises(VisionError, match="tilt the view"):
        Pipette.from_optics(0.0, 0.3e-6, approach=np.pi / 2, aperture=0.4)


def test_a_solid_pin_with_a_round_end_is_found():
    """The pin is drawn independently of the model of the finder."""
    rng, scale, true_pixel = np.random.default_rng(3), 4, np.array([128.3, 97.6])
    grid = (np.arange(256 * scale) + 0.5) / scale - 0.5
    column, row = np.meshgrid(grid, grid[: 200 * scale])
    along, across = column - true_pixel[0], np.abs(row - true_pixel[1])
    half_width = 2.5 + 0.08 * np.maximum(along - 2.5, 0.0)
    is_inside = np.where(along < 2.5, np.hypot(along - 2.5, across) < 2.5, across < half_width)
    absorption = is_inside.reshape(200, scale, 256, scale).mean(axis=(1, 3))
    blurred = np.array([erf(x) for x in np.linspace(-3, 3, 22)])
    kernel = np.diff(blurred) / np.diff(blurred).sum()
    for axis in (0, 1):
        absorption = np.apply_along_axis(
            lambda line: np.convolve(line, kernel, "same"), axis, absorption
        )
    image = to_grey(
        1000.0 * (1.0 - 0.5 * absorption) + 15.0 * rng.standard_normal(absorption.shape)
    )
    blur = 21 / 6 / np.sqrt(2.0)
    pipette = Pipette(
        0.0, 2.5, 0.08, depth_per_px=0.0, sharpest=blur, lumen=0.0, end=2.5 * (1 - np.pi / 4)
    )
    fit = find_tip(image, pipette)
    assert fit.pixel == pytest.approx(true_pixel, abs=0.3)


def test_a_moving_tip_is_followed(view):
    track = begin_track(view.take_image([0.0, 0.0, 0.0]), view.pipette)
    for step in range(1, 15):
        tip_m = np.array([2e-6 * step, -1e-6 * step, 0.3e-6 * step])
        track = follow_tip(track, view.take_image(tip_m))
        assert not track.lost, track.reason
        assert np.linalg.norm(track.pixel - view.project(tip_m)) < 0.4
    assert np.linalg.norm(track.speed) == pytest.approx(np.hypot(2.0, 1.0) / 0.335, rel=0.1)


def test_a_tip_that_leaves_is_lost_with_the_reason_and_found_again(view):
    track = begin_track(view.take_image([0.0, 0.0, 0.0]), view.pipette)
    for count in range(1, 4):
        track = follow_tip(track, view.take_image([5e-3, 0.0, 0.0]))
        assert track.lost_frames == count
    assert track.reason
    assert track.quality == 0.0
    tip_m = np.array([-30e-6, 20e-6, 0.0])
    for _ in range(3):
        track = follow_tip(track, view.take_image(tip_m))
    assert not track.lost
    assert np.linalg.norm(track.pixel - view.project(tip_m)) < 0.3


def make_penetration(frames):
    """Return the path (frames, 3) of the tip, m, down into a cell, with a rest, and up again."""
    share = np.linspace(0.0, 1.0, frames)
    depth = np.interp(share, [0.0, 0.05, 0.4, 0.5, 0.75, 1.0], [0.0, 0.0, 8.0, 20.0, 20.0, 0.0])
    return np.column_stack([np.zeros((frames, 2)), -1e-6 * depth])


def follow_penetration(make_view, frames):
    cell = SimulatedCell((-5e-6, -3e-6, -16e-6))
    view = make_view(cell=cell)
    focus_m = float(view.optics.depth_of(np.array(cell.centre_m)))
    out_of_view_m = np.array([5e-3, 0.0, 0.0])
    background = np.mean([view.take_image(out_of_view_m, focus_m) for _ in range(8)], axis=0)
    state, track, lost_count, position_errors = UNTOUCHED_CELL_STATE, None, 0, []
    for tip_m in make_penetration(frames):
        state = advance_cell_state(cell, state, tip_m)
        image = divide_by_background(view.take_image(tip_m, focus_m, state), background)
        track = (
            begin_track(image, view.pipette, dimple=True)
            if track is None
            else follow_tip(track, image)
        )
        lost_count += track.lost
        position_errors.append(np.linalg.norm(track.pixel - view.project(tip_m)))
    assert state.is_pierced
    return lost_count, np.array(position_errors)


def test_a_penetration_is_followed(make_view):
    lost, position_errors = follow_penetration(make_view, 40)
    assert lost == 0
    assert position_errors.max() < 8.0


@pytest.mark.slow
def test_the_tip_is_never_lost_in_a_thousand_frames_of_a_penetration(make_view):
    lost, position_errors = follow_penetration(make_view, 1000)
    assert lost == 0
    assert np.median(position_errors) < 2.0
