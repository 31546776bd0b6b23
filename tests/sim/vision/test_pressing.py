"""A tip that presses on a cell: its body is learnt before and then gives its position."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.microscope import (
    UNTOUCHED_CELL_STATE,
    SimulatedCell,
    advance_cell_state,
)
from rotemina.sim.vision import (
    BackgroundImage,
    begin_track,
    divide_by_background,
    follow_tip,
    learn_body,
)

CELL = SimulatedCell((-5e-6, -3e-6, -16e-6))
FOCUS_M = -16e-6


@pytest.fixture
def view(make_view):
    return make_view(cell=CELL)


def take_background(view, count=8):
    """Return the mean image without the pipette."""
    out_of_view_m = (5e-3, 0.0, 0.0)
    return np.mean(
        [view.take_image(out_of_view_m, FOCUS_M) for _ in range(count)], axis=0, dtype=np.float32
    )


def learn_track(view, background, frames=12):
    """Return the track of a tip above the cell, after its body was learnt."""
    tip_m = np.zeros(3)
    track = begin_track(
        divide_by_background(view.take_image(tip_m, FOCUS_M), background), view.pipette
    )
    for _ in range(frames):
        track = learn_body(track, view.take_image(tip_m, FOCUS_M), background=background)
    return track


def press_down(view, track, frames=24, **options):
    """Follow the tip down through the membrane and return tracks and errors (n, 2), px."""
    track, state, tracks = replace(track, dimple=True), UNTOUCHED_CELL_STATE, []
    for depth in np.linspace(0.0, 14e-6, frames):
        tip_m = np.array([0.0, 0.0, -depth])
        state = advance_cell_state(CELL, state, tip_m)
        track = follow_tip(track, view.take_image(tip_m, FOCUS_M, state), **options)
        tracks.append(track)
    assert state.is_pierced
    return tracks, np.array([track.pixel - view.project(np.zeros(3)) for track in tracks])


def test_a_tip_that_pierces_a_membrane_is_tracked_within_0_3_pixels(view):
    background = take_background(view)
    track = learn_track(view, background)
    assert track.learnt_frames == 12
    assert track.pipette.direction == pytest.approx(view.pipette.direction, abs=1e-3)
    tracks, errors = press_down(view, track, background=background, moved=np.zeros(2))
    assert not any(track.lost for track in tracks)
    rms = np.sqrt((errors**2).sum(axis=1).mean())
    uncertainty = np.sqrt(np.mean([np.trace(track.covariance) for track in tracks]))
    assert rms < 0.3  # only a short part of the body is in this small image
    assert 0.3 * uncertainty < rms < 2.5 * uncertainty


@pytest.mark.slow
def test_the_dent_is_ignored_by_its_size_with_any_objective(make_view):
    """At 40x the dent has twice as many pixels, so the radius of 20x would lose the tip."""
    view = make_view(cell=CELL, pixel_m=0.1675e-6, width=1000, height=800)
    assert view.pipette.indentation_radius == pytest.approx(15e-6 / 0.1675e-6)
    background = take_background(view)
    tracks, errors = press_down(
        view, learn_track(view, background), background=background, moved=np.zeros(2)
    )
    assert not any(track.lost for track in tracks)
    assert np.sqrt((errors**2).sum(axis=1).mean()) < 0.5


def test_without_a_background_image_the_uncertainty_is_larger(view):
    tracks, errors = press_down(view, learn_track(view, take_background(view)), frames=12)
    assert not any(track.lost for track in tracks)
    uncertainty = np.sqrt([np.trace(track.covariance) for track in tracks])
    assert uncertainty.min() > 5.0
    assert np.linalg.norm(errors, axis=1).max() < 3.0 * uncertainty.max()


def test_a_pressing_tip_that_is_pushed_sideways_is_followed(view):
    background = take_background(view)
    track = replace(learn_track(view, background, frames=5), dimple=True)
    tip_m = np.array([2e-6, 1e-6, 0.0])
    for _ in range(3):
        track = follow_tip(
            track, view.take_image(tip_m, FOCUS_M), background=background, moved=np.zeros(2)
        )
    assert track.pixel == pytest.approx(view.project(tip_m), abs=1.0)


def test_a_background_is_assembled_from_images_with_the_pipette_elsewhere(view):
    true_background = take_background(view)
    shape = true_background.shape
    background = BackgroundImage.empty(shape)
    assert not background.is_known(np.zeros(2), np.array([50.0, 50.0]))
    for tip_m in ((0.0, 0.0, 0.0), (40e-6, 45e-6, 0.0), (-20e-6, -60e-6, 0.0)):
        image = view.take_image(tip_m, FOCUS_M)
        depth_m = float(view.optics.depth_of(np.array(tip_m))) - FOCUS_M
        background = background.with_picture(image, view.pipette, view.project(tip_m), depth_m)
    known = background.picture_counts > 0.0
    assert known.mean() > 0.6
    deviation = np.abs(background.image[known] / true_background[known] - 1.0)
    assert np.median(deviation) < 0.02  # noise
    assert np.quantile(deviation, 0.999) < 0.08  # it does not contain the pipette
