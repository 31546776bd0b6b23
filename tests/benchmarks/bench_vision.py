"""Calibration, tip and cell vision: on simulated frames with default noise.

Prints the levels of docs/vision.md. Times are processor times of one thread, so that other
processes have no influence.
"""

import time

import cv2
import numpy as np
import pytest

from rotemina.sim.microscope import (
    UNTOUCHED_CELL_STATE,
    MicroscopeScene,
    SceneRenderer,
    SimulatedCell,
    TaperedPin,
    advance_cell_state,
)
from rotemina.sim.microscope.optics import MicroscopeOptics
from rotemina.sim.vision import (
    Pipette,
    StageMap,
    begin_track,
    divide_by_background,
    find_cell,
    find_tip,
    fit_stage,
    fit_tip,
    follow_tip,
    learn_body,
    to_grey,
)

UPRIGHT = np.array([0.0, 0.0, 1.0])
OPTICS = MicroscopeOptics(rotation_rad=0.3, skew_rad=0.01, mirrored=True)
PIN = TaperedPin(approach_rad=np.pi / 6)
CELL = SimulatedCell((-5e-6, -3e-6, -16e-6))
FITS, FRAMES, STEPS, MOUNTINGS = 100, 40, 1000, 20
QUICK = {"FITS": 3, "FRAMES": 2, "STEPS": 20, "MOUNTINGS": 2}


@pytest.fixture(autouse=True)
def _use_one_thread():
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    yield
    cv2.setNumThreads(threads)


class VisionBench:
    """Full-size frames of one scene, and its pipette."""

    def __init__(self, cell=None, optics=OPTICS):
        self.renderer = SceneRenderer(MicroscopeScene(optics, PIN, cell))
        self.optics, self.rng = optics, np.random.default_rng(0)
        body = optics.mapping @ np.array([1.0, 0.0, 0.0])
        direction = float(np.arctan2(body[1], body[0]))
        self.pipette = Pipette.from_optics(
            direction, optics.pixel_m, approach=PIN.approach_rad, aperture=optics.aperture
        )

    def image(self, tip_m, focus_m=0.0, *state):
        return to_grey(
            self.renderer.render_frame(np.asarray(tip_m), UPRIGHT, focus_m, self.rng, *state)
        )


def measure_time(function):
    begin = time.thread_time()
    result = function()
    return result, time.thread_time() - begin


def test_tip_at_distances_from_focus():
    bench = VisionBench()
    print(f"\ntip, {FITS} fits each from within 1 px: from focus, µm;")
    print("error, px: rms, worst, estimated; depth, µm: rms, estimated; ms")
    for depth in (0.0, 3e-6, -3e-6, 6e-6, -6e-6, 10e-6, -10e-6, 20e-6, -20e-6):
        rows, not_fitted = [], 0
        for _ in range(FITS):
            tip_m = np.append(bench.rng.uniform(-100e-6, 100e-6, 2), 0.0)
            truth, image = bench.optics.pixel_of(tip_m), bench.image(tip_m, -depth)
            start = truth + bench.rng.uniform(-1.0, 1.0, 2)
            fit, duration_s = measure_time(
                lambda i=image, s=start, d=depth: fit_tip(i, bench.pipette, s, d)
            )
            if fit is None:
                not_fitted += 1
                continue
            error_px = float(np.linalg.norm(fit.pixel - truth))
            estimated_px = float(np.sqrt(np.trace(fit.covariance)))
            depth_error = fit.depth.distance - depth
            rows.append(
                (
                    error_px**2,
                    estimated_px**2,
                    depth_error**2,
                    fit.depth.uncertainty**2,
                    duration_s,
                    error_px,
                )
            )
        table = np.array(rows)
        error_px, estimated_px, depth_error, depth_uncertainty = np.sqrt(table[:, :4].mean(axis=0))
        print(
            f"{depth * 1e6:+4.0f}  {error_px:.3f} {table[:, 5].max():.2f} {estimated_px:.3f}  "
            f"{depth_error * 1e6:.2f} {depth_uncertainty * 1e6:.2f}  "
            f"{1e3 * np.median(table[:, 4]):.1f}"
            + (f"  {not_fitted} not fitted" if not_fitted else "")
        )
        if abs(depth) <= 6e-6:
            assert error_px < 0.2


def test_tip_in_a_whole_frame():
    bench, times, found_count = VisionBench(), [], 0
    for _ in range(FRAMES):
        tip_m = np.append(bench.rng.uniform(-120e-6, 120e-6, 2), bench.rng.uniform(-5e-6, 5e-6))
        image = bench.image(tip_m)
        fit, duration_s = measure_time(lambda i=image: find_tip(i, bench.pipette))
        times.append(duration_s)
        found_count += bool(np.linalg.norm(fit.pixel - bench.optics.pixel_of(tip_m)) < 0.5)
    print(f"\nwhole frame: {found_count} of {FRAMES} tips found, {1e3 * np.median(times):.0f} ms")
    assert found_count == FRAMES


@pytest.mark.parametrize(
    ("background_known", "move_known"),
    [(True, True), (True, False), (False, True)],
    ids=["background and move known", "background known", "move known"],
)
def test_track_through_a_penetration(background_known, move_known, request):
    """Track a tip that moves straight down, so that by the kinematics its pixel does not change."""
    bench = VisionBench(CELL)
    share = np.linspace(0.0, 1.0, STEPS)
    depths = np.interp(share, [0.0, 0.05, 0.4, 0.5, 0.75, 1.0], [0.0, 0.0, 8.0, 20.0, 20.0, 0.0])
    focus_m = float(bench.optics.depth_of(np.array(CELL.centre_m)))
    outside_m = np.array([5e-3, 0.0, 0.0])
    background = np.mean([bench.image(outside_m, focus_m) for _ in range(8)], axis=0)
    track = begin_track(
        divide_by_background(bench.image(np.zeros(3), focus_m), background),
        bench.pipette,
        dimple=True,
    )
    # While the penetration is armed, the tip stays above the cell.
    for _ in range(30):
        track = learn_body(track, bench.image(np.zeros(3), focus_m), background=background)
    state, lost_count, rows, times = UNTOUCHED_CELL_STATE, 0, [], []
    options = {
        "background": background if background_known else None,
        "moved": np.zeros(2) if move_known else None,
    }
    for depth in depths * 1e-6:
        tip_m = np.array([0.0, 0.0, -depth])
        state = advance_cell_state(CELL, state, tip_m)
        image = bench.image(tip_m, focus_m, state)
        track, duration_s = measure_time(lambda t=track, i=image: follow_tip(t, i, **options))
        times.append(duration_s)
        lost_count += track.lost
        truth = bench.optics.pixel_of(tip_m)
        height = float(bench.optics.depth_of(tip_m)) - focus_m
        uncertainty_px = float(np.sqrt(np.trace(track.covariance)))
        rows.append(
            (np.linalg.norm(track.pixel - truth), track.depth.distance - height, uncertainty_px)
        )
    table = np.array(rows)
    rms = np.sqrt((table**2).mean(axis=0))
    print(
        f"\npenetration, {request.node.callspec.id}: {lost_count} of {STEPS} lost; error, px: rms "
        f"{rms[0]:.2f} (estimated {rms[2]:.2f}), 99 % {np.percentile(table[:, 0], 99):.2f}; "
        f"depth rms {1e6 * rms[1]:.2f} µm; {1e3 * np.median(times):.1f} ms, "
        f"99 % {1e3 * np.percentile(times, 99):.1f}"
    )
    assert lost_count < 1
    if background_known and move_known:
        assert rms[0] < 0.2


def test_calibration():
    largest_errors = np.zeros(4)
    rng = np.random.default_rng(1)
    for _ in range(MOUNTINGS):
        optics = MicroscopeOptics(
            width=800,
            height=640,
            rotation_rad=float(rng.uniform(-3.0, 3.0)),
            skew_rad=float(rng.uniform(-0.05, 0.05)),
            mirrored=bool(rng.integers(2)),
            pixel_m=float(rng.uniform(0.25e-6, 0.4e-6)),
        )
        bench = VisionBench(optics=optics)
        directions = [
            (0, 0),
            (1, 0),
            (1, 1),
            (0, 1),
            (-1, 1),
            (-1, 0),
            (-1, -1),
            (0, -1),
            (1, -1),
            (0, 0),
        ]
        moves = 40e-6 * np.array(directions, dtype=float)
        fits = []
        for move in moves:
            tip_m = np.append(move, 0.0)
            start = optics.pixel_of(tip_m) + rng.uniform(-1.0, 1.0, 2)
            fits.append(fit_tip(bench.image(tip_m), bench.pipette, start))
        shifts = np.array([fit.pixel - fits[0].pixel for fit in fits])
        covariances = np.array([fit.covariance for fit in fits])
        fitted = fit_stage(moves, shifts, covariances).map.geometry
        true_geometry = StageMap(optics.mapping[:, :2], np.zeros((4, 4))).geometry
        assert fitted.handedness == true_geometry.handedness
        size_errors = np.abs(np.array(fitted.pixel_size) / np.array(true_geometry.pixel_size) - 1.0)
        rotation_error = abs(
            (fitted.rotation - true_geometry.rotation + np.pi) % (2.0 * np.pi) - np.pi
        )
        largest_errors = np.maximum(
            largest_errors, [*size_errors, rotation_error, abs(fitted.skew - true_geometry.skew)]
        )
    print(
        f"\ncalibration, {MOUNTINGS} mountings, ten tips each, ±40 µm, worst: pixel size "
        f"{100 * largest_errors[:2].max():.3f} %, rotation {np.degrees(largest_errors[2]):.4f}°, "
        f"skew {np.degrees(largest_errors[3]):.4f}°"
    )
    assert largest_errors[:2].max() < 1e-3
    assert np.degrees(largest_errors[2]) < 0.05


def test_cell_outline():
    cell = SimulatedCell((5e-6, -4e-6, 0.0))
    bench = VisionBench(cell)
    centre_px = bench.optics.pixel_of(np.array(cell.centre_m))
    rows, times = [], []
    for _ in range(FRAMES):
        image = bench.image([bench.rng.uniform(20e-6, 60e-6), 0.0, 4e-6])
        start = centre_px + bench.rng.uniform(-20.0, 20.0, 2)
        outline, duration_s = measure_time(lambda i=image, n=start: find_cell(i, n, (20.0, 95.0)))
        times.append(duration_s)
        axis_errors_m = outline.parameters[2:4] * bench.optics.pixel_m - np.array([22e-6, 18e-6])
        rows.append([*(outline.centre - centre_px), *(axis_errors_m / bench.optics.pixel_m)])
    rms = np.sqrt((np.array(rows) ** 2).mean(axis=0))
    print(
        f"\ncell, px rms: centre {np.hypot(*rms[:2]):.2f}, half axes {rms[2]:.2f} and "
        f"{rms[3]:.2f}; {1e3 * np.median(times):.0f} ms"
    )
