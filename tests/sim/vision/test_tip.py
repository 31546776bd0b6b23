"""The tip: where it is, how far from focus, and that nothing else is taken for it."""

from dataclasses import replace
from math import erf

import numpy as np
import pytest

from rotemina.sim.microscope.cell import UNTOUCHED, Cell, met
from rotemina.sim.microscope.scene import Pin
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import grey, relative_to
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip import find_tip, fit_depths
from rotemina.sim.vision.tip_fit import fit_tip
from rotemina.sim.vision.tracking import begin_track, follow


def errors(view, focus_m, count=12):
    """Return misses (n, 2), px, and of the depth (n,), m, of fits from nearby."""
    misses, depths = [], []
    for _ in range(count):
        tip_m = view.anywhere()
        truth, depth = view.pixel(tip_m), -focus_m
        start = truth + view.rng.uniform(-1.0, 1.0, 2)
        fit = fit_tip(view.image(tip_m, focus_m), view.pipette, start, 0.8 * depth)
        assert fit is not None
        misses.append(fit.pixel - truth)
        depths.append(fit.depth.distance - depth)
    return np.array(misses), np.array(depths)


@pytest.mark.parametrize("focus_m", [0.0, 3e-6, -3e-6, 6e-6])
def test_the_tip_is_placed_within_a_fifth_of_a_pixel(view, focus_m):
    misses, _ = errors(view, focus_m)
    assert np.sqrt((misses**2).sum(axis=1).mean()) < 0.2


@pytest.mark.parametrize("focus_m", [4e-6, -4e-6, 10e-6, -10e-6])
def test_depth_comes_from_blur_within_its_uncertainty(view, focus_m):
    tip_m = view.anywhere()
    fit = fit_tip(view.image(tip_m, focus_m), view.pipette, view.pixel(tip_m), -0.7 * focus_m)
    assert abs(fit.depth.distance + focus_m) < 3.0 * fit.depth.uncertainty
    assert fit.depth.uncertainty < 0.2 * abs(focus_m)


@pytest.mark.parametrize("focus_m", [6e-6, -6e-6])
def test_a_climbing_body_tells_on_which_side_of_focus_the_tip_is(view, focus_m):
    tip_m = np.zeros(3)
    fit = fit_depths(view.image(tip_m, focus_m), view.pipette, view.pixel(tip_m), (0.0, 8e-6))
    assert fit.depth.sign_known
    assert np.sign(fit.depth.distance) == -np.sign(focus_m)


def test_a_flat_body_leaves_the_sign_of_the_depth_open(make_view):
    view = make_view(pin=Pin(approach_rad=0.01))
    pipette = replace(view.pipette, climb=0.0)
    tip_m = np.zeros(3)
    fit = fit_depths(view.image(tip_m, 6e-6), pipette, view.pixel(tip_m), (4e-6,))
    assert not fit.depth.sign_known
    assert fit.depth.distance == pytest.approx(6e-6, abs=1e-6)


@pytest.mark.parametrize("turned", [0.0, 0.1, -0.1])
def test_the_tip_is_found_in_a_whole_image_with_its_direction(make_view, turned):
    view = make_view(turned)
    tip_m = view.anywhere()
    fit = find_tip(view.image(tip_m, 2e-6), view.pipette)
    assert np.linalg.norm(fit.pixel - view.pixel(tip_m)) < 0.3
    assert fit.direction == pytest.approx(view.pipette.direction - turned, abs=0.01)


def test_an_empty_field_has_no_tip(view):
    with pytest.raises(VisionError, match="nothing in the picture matches it"):
        find_tip(view.image([5e-3, 0.0, 0.0]), view.pipette)


def test_an_upright_pin_seen_from_its_end_is_refused():
    with pytest.raises(VisionError, match="tilt the view"):
        Pipette.seen(0.0, 0.3e-6, approach=np.pi / 2, aperture=0.4)


def test_a_solid_pin_with_a_round_end_is_found_too():
    """A drawing of its own: what the finder's model does not share."""
    rng, scale, truth = np.random.default_rng(3), 4, np.array([128.3, 97.6])
    grid = (np.arange(256 * scale) + 0.5) / scale - 0.5
    column, row = np.meshgrid(grid, grid[: 200 * scale])
    along, across = column - truth[0], np.abs(row - truth[1])
    half = 2.5 + 0.08 * np.maximum(along - 2.5, 0.0)
    inside = np.where(along < 2.5, np.hypot(along - 2.5, across) < 2.5, across < half)
    whole = inside.reshape(200, scale, 256, scale).mean(axis=(1, 3))
    blurred = np.array([erf(x) for x in np.linspace(-3, 3, 22)])
    kernel = np.diff(blurred) / np.diff(blurred).sum()
    for axis in (0, 1):
        whole = np.apply_along_axis(lambda line: np.convolve(line, kernel, "same"), axis, whole)
    image = grey(1000.0 * (1.0 - 0.5 * whole) + 15.0 * rng.standard_normal(whole.shape))
    blur = 21 / 6 / np.sqrt(2.0)
    pipette = Pipette(
        0.0, 2.5, 0.08, climb=0.0, sharpest=blur, lumen=0.0, end=2.5 * (1 - np.pi / 4)
    )
    fit = find_tip(image, pipette)
    assert fit.pixel == pytest.approx(truth, abs=0.3)


# --- tracking ---------------------------------------------------------------------------------


def test_a_moving_tip_is_followed(view):
    track = begin_track(view.image([0.0, 0.0, 0.0]), view.pipette)
    for step in range(1, 15):
        tip_m = np.array([2e-6 * step, -1e-6 * step, 0.3e-6 * step])
        track = follow(track, view.image(tip_m))
        assert not track.lost, track.reason
        assert np.linalg.norm(track.pixel - view.pixel(tip_m)) < 0.4
    assert np.linalg.norm(track.speed) == pytest.approx(np.hypot(2.0, 1.0) / 0.335, rel=0.1)


def test_a_tip_that_leaves_is_lost_with_the_reason_and_found_again(view):
    track = begin_track(view.image([0.0, 0.0, 0.0]), view.pipette)
    for count in range(1, 4):
        track = follow(track, view.image([5e-3, 0.0, 0.0]))
        assert track.lost_for == count
    assert track.reason
    assert track.quality == 0.0
    back = np.array([-30e-6, 20e-6, 0.0])
    for _ in range(3):
        track = follow(track, view.image(back))
    assert not track.lost
    assert np.linalg.norm(track.pixel - view.pixel(back)) < 0.3


def penetration(frames):
    """Return the tip's way (frames, 3), m, from its start down into a cell, a rest, and up."""
    share = np.linspace(0.0, 1.0, frames)
    depth = np.interp(share, [0.0, 0.05, 0.4, 0.5, 0.75, 1.0], [0.0, 0.0, 8.0, 20.0, 20.0, 0.0])
    return np.column_stack([np.zeros((frames, 2)), -1e-6 * depth])


def followed(make_view, frames):
    cell = Cell((-5e-6, -3e-6, -16e-6))
    view = make_view(cell=cell)
    focus_m = float(view.optics.depth_of(np.array(cell.centre_m)))
    away = np.array([5e-3, 0.0, 0.0])
    background = np.mean([view.image(away, focus_m) for _ in range(8)], axis=0)
    state, track, lost, misses = UNTOUCHED, None, 0, []
    for tip_m in penetration(frames):
        state = met(cell, state, tip_m)
        image = relative_to(view.image(tip_m, focus_m, state), background)
        track = (
            begin_track(image, view.pipette, dimple=True) if track is None else follow(track, image)
        )
        lost += track.lost
        misses.append(np.linalg.norm(track.pixel - view.pixel(tip_m)))
    assert state.pierced
    return lost, np.array(misses)


def test_a_penetration_is_followed(make_view):
    lost, misses = followed(make_view, 40)
    assert lost == 0
    assert misses.max() < 8.0


@pytest.mark.slow
def test_in_a_thousand_frames_of_a_penetration_the_tip_is_lost_in_less_than_one(make_view):
    lost, misses = followed(make_view, 1000)
    assert lost == 0
    assert np.median(misses) < 2.0
