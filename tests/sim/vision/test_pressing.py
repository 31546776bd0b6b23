"""A tip that presses on a cell: learnt before, then placed by its body."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.microscope.cell import UNTOUCHED, Cell, met
from rotemina.sim.vision.background import Ground
from rotemina.sim.vision.image import relative_to
from rotemina.sim.vision.tracking import begin_track, follow, learn

CELL = Cell((-5e-6, -3e-6, -16e-6))
FOCUS_M = -16e-6


@pytest.fixture
def view(make_view):
    return make_view(cell=CELL)


def bare(view, pictures=8):
    """Return the view without the pipette."""
    away = (5e-3, 0.0, 0.0)
    return np.mean([view.image(away, FOCUS_M) for _ in range(pictures)], axis=0, dtype=np.float32)


def above(view, ground, frames=12):
    """Return the track of a tip above the cell, after it was learnt."""
    tip_m = np.zeros(3)
    track = begin_track(relative_to(view.image(tip_m, FOCUS_M), ground), view.pipette)
    for _ in range(frames):
        track = learn(track, view.image(tip_m, FOCUS_M), background=ground)
    return track


def pressed(view, track, frames=24, **options):
    """Follow it down through the membrane; return tracks and how far each is off, px."""
    track, state, tracks = replace(track, dimple=True), UNTOUCHED, []
    for depth in np.linspace(0.0, 14e-6, frames):
        tip_m = np.array([0.0, 0.0, -depth])
        state = met(CELL, state, tip_m)
        track = follow(track, view.image(tip_m, FOCUS_M, state), **options)
        tracks.append(track)
    assert state.pierced
    return tracks, np.array([one.pixel - view.pixel(np.zeros(3)) for one in tracks])


def test_through_a_membrane_a_tip_is_kept_within_a_fifth_of_a_pixel(view):
    ground = bare(view)
    track = above(view, ground)
    assert track.learnt == 12
    assert track.pipette.direction == pytest.approx(view.pipette.direction, abs=1e-3)
    tracks, off = pressed(view, track, background=ground, moved=np.zeros(2))
    assert not any(one.lost for one in tracks)
    rms = np.sqrt((off**2).sum(axis=1).mean())
    told = np.sqrt(np.mean([np.trace(one.covariance) for one in tracks]))
    assert rms < 0.3  # the part of the body in this small picture is short
    assert 0.3 * told < rms < 2.5 * told


@pytest.mark.slow
def test_what_gives_way_is_left_out_by_its_size_behind_any_objective(make_view):
    """At 40x it is twice as many pixels; with those of 20x the tip is 6 px off or lost."""
    view = make_view(cell=CELL, pixel_m=0.1675e-6, width=1000, height=800)
    assert view.pipette.yielding == pytest.approx(15e-6 / 0.1675e-6)
    ground = bare(view)
    tracks, off = pressed(view, above(view, ground), background=ground, moved=np.zeros(2))
    assert not any(one.lost for one in tracks)
    assert np.sqrt((off**2).sum(axis=1).mean()) < 0.5


def test_what_lies_beneath_is_told_as_a_doubt_where_its_picture_is_missing(view):
    tracks, off = pressed(view, above(view, bare(view)), frames=12)
    assert not any(one.lost for one in tracks)
    told = np.sqrt([np.trace(one.covariance) for one in tracks])
    assert told.min() > 5.0
    assert np.linalg.norm(off, axis=1).max() < 3.0 * told.max()


def test_a_pressing_tip_that_is_pushed_aside_is_followed(view):
    ground = bare(view)
    track = replace(above(view, ground, frames=5), dimple=True)
    aside = np.array([2e-6, 1e-6, 0.0])
    for _ in range(3):
        track = follow(track, view.image(aside, FOCUS_M), background=ground, moved=np.zeros(2))
    assert track.pixel == pytest.approx(view.pixel(aside), abs=1.0)


def test_a_background_is_put_together_while_the_pipette_is_elsewhere(view):
    truth = bare(view)
    shape = truth.shape
    ground = Ground.empty(shape)
    assert not ground.known(np.zeros(2), np.array([50.0, 50.0]))
    for place in ((0.0, 0.0, 0.0), (40e-6, 45e-6, 0.0), (-20e-6, -60e-6, 0.0)):
        image = view.image(place, FOCUS_M)
        away = float(view.optics.depth_of(np.array(place))) - FOCUS_M
        ground = ground.seen(image, view.pipette, view.pixel(place), away)
    known = ground.pictures > 0.0
    assert known.mean() > 0.6
    share = np.abs(ground.image[known] / truth[known] - 1.0)
    assert np.median(share) < 0.02  # noise
    assert np.quantile(share, 0.999) < 0.08  # no pipette is left in it
