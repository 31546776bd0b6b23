"""Calibration, tip and cell vision: on simulated frames with their default noise.

Prints the levels of docs/vision.md. Times are of the processor, one thread, so that a shared
machine does not count.
"""

import time

import cv2
import numpy as np
import pytest

from rotemina.sim.microscope.cell import UNTOUCHED, Cell, met
from rotemina.sim.microscope.optics import Optics
from rotemina.sim.microscope.renderer import Renderer
from rotemina.sim.microscope.scene import Pin, Scene
from rotemina.sim.vision.calibration import StageMap, fit_stage
from rotemina.sim.vision.cell import find_cell
from rotemina.sim.vision.image import grey, relative_to
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip import find_tip
from rotemina.sim.vision.tip_fit import fit_tip
from rotemina.sim.vision.tracking import begin_track, follow, learn

UPRIGHT = np.array([0.0, 0.0, 1.0])
OPTICS = Optics(rotation_rad=0.3, skew_rad=0.01, mirrored=True)
PIN = Pin(approach_rad=np.pi / 6)
CELL = Cell((-5e-6, -3e-6, -16e-6))
FITS, FRAMES, STEPS, MOUNTINGS = 100, 40, 1000, 20
QUICK = {"FITS": 3, "FRAMES": 2, "STEPS": 20, "MOUNTINGS": 2}


@pytest.fixture(autouse=True)
def _one_thread():
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    yield
    cv2.setNumThreads(threads)


class Bench:
    """Full-size frames of one scene, and its pipette."""

    def __init__(self, cell=None, optics=OPTICS):
        self.renderer = Renderer(Scene(optics, PIN, cell))
        self.optics, self.rng = optics, np.random.default_rng(0)
        body = optics.mapping @ np.array([1.0, 0.0, 0.0])
        direction = float(np.arctan2(body[1], body[0]))
        self.pipette = Pipette.seen(
            direction, optics.pixel_m, approach=PIN.approach_rad, aperture=optics.aperture
        )

    def image(self, tip_m, focus_m=0.0, *state):
        return grey(self.renderer.frame(np.asarray(tip_m), UPRIGHT, focus_m, self.rng, *state))


def timed(call):
    begin = time.thread_time()
    result = call()
    return result, time.thread_time() - begin


def test_tip_at_distances_from_focus():
    bench = Bench()
    print(f"\ntip, {FITS} fits each from within 1 px: from focus, µm; miss, px: rms, worst, told;")
    print("depth, µm: rms, told; ms")
    for depth in (0.0, 3e-6, -3e-6, 6e-6, -6e-6, 10e-6, -10e-6, 20e-6, -20e-6):
        rows, lost = [], 0
        for _ in range(FITS):
            tip_m = np.append(bench.rng.uniform(-100e-6, 100e-6, 2), 0.0)
            truth, image = bench.optics.pixel_of(tip_m), bench.image(tip_m, -depth)
            start = truth + bench.rng.uniform(-1.0, 1.0, 2)
            fit, took_s = timed(lambda i=image, s=start, d=depth: fit_tip(i, bench.pipette, s, d))
            if fit is None:
                lost += 1
                continue
            miss = float(np.linalg.norm(fit.pixel - truth))
            told = float(np.sqrt(np.trace(fit.covariance)))
            away = fit.depth.distance - depth
            rows.append((miss**2, told**2, away**2, fit.depth.uncertainty**2, took_s, miss))
        table = np.array(rows)
        miss, told, away, doubt = np.sqrt(table[:, :4].mean(axis=0))
        print(
            f"{depth * 1e6:+4.0f}  {miss:.3f} {table[:, 5].max():.2f} {told:.3f}  "
            f"{away * 1e6:.2f} {doubt * 1e6:.2f}  {1e3 * np.median(table[:, 4]):.1f}"
            + (f"  {lost} not fitted" if lost else "")
        )
        if abs(depth) <= 6e-6:
            assert miss < 0.2


def test_tip_in_a_whole_frame():
    bench, times, found = Bench(), [], 0
    for _ in range(FRAMES):
        tip_m = np.append(bench.rng.uniform(-120e-6, 120e-6, 2), bench.rng.uniform(-5e-6, 5e-6))
        image = bench.image(tip_m)
        fit, took_s = timed(lambda i=image: find_tip(i, bench.pipette))
        times.append(took_s)
        found += bool(np.linalg.norm(fit.pixel - bench.optics.pixel_of(tip_m)) < 0.5)
    print(f"\nwhole frame: {found} of {FRAMES} tips found, {1e3 * np.median(times):.0f} ms")
    assert found == FRAMES


@pytest.mark.parametrize(
    ("known", "told"),
    [(True, True), (True, False), (False, True)],
    ids=["background and way known", "background known", "way known"],
)
def test_track_through_a_penetration(known, told, request):
    """The pin comes down upright, so that by kinematics its tip stays where it is seen."""
    bench = Bench(CELL)
    share = np.linspace(0.0, 1.0, STEPS)
    deep = np.interp(share, [0.0, 0.05, 0.4, 0.5, 0.75, 1.0], [0.0, 0.0, 8.0, 20.0, 20.0, 0.0])
    focus_m = float(bench.optics.depth_of(np.array(CELL.centre_m)))
    away = np.array([5e-3, 0.0, 0.0])
    ground = np.mean([bench.image(away, focus_m) for _ in range(8)], axis=0)
    track = begin_track(
        relative_to(bench.image(np.zeros(3), focus_m), ground), bench.pipette, dimple=True
    )
    for _ in range(30):  # armed: it stands above the cell
        track = learn(track, bench.image(np.zeros(3), focus_m), background=ground)
    state, lost, rows, times = UNTOUCHED, 0, [], []
    options = {"background": ground if known else None, "moved": np.zeros(2) if told else None}
    for depth in deep * 1e-6:
        tip_m = np.array([0.0, 0.0, -depth])
        state = met(CELL, state, tip_m)
        image = bench.image(tip_m, focus_m, state)
        track, took_s = timed(lambda t=track, i=image: follow(t, i, **options))
        times.append(took_s)
        lost += track.lost
        truth = bench.optics.pixel_of(tip_m)
        height = float(bench.optics.depth_of(tip_m)) - focus_m
        doubt = float(np.sqrt(np.trace(track.covariance)))
        rows.append((np.linalg.norm(track.pixel - truth), track.depth.distance - height, doubt))
    table = np.array(rows)
    rms = np.sqrt((table**2).mean(axis=0))
    print(
        f"\npenetration, {request.node.callspec.id}: {lost} of {STEPS} lost; off, px: rms "
        f"{rms[0]:.2f} (told {rms[2]:.2f}), 99 % {np.percentile(table[:, 0], 99):.2f}; depth rms "
        f"{1e6 * rms[1]:.2f} µm; {1e3 * np.median(times):.1f} ms, "
        f"99 % {1e3 * np.percentile(times, 99):.1f}"
    )
    assert lost < 1
    if known and told:
        assert rms[0] < 0.2


def test_calibration():
    worst = np.zeros(4)
    rng = np.random.default_rng(1)
    for _ in range(MOUNTINGS):
        optics = Optics(
            width=800,
            height=640,
            rotation_rad=float(rng.uniform(-3.0, 3.0)),
            skew_rad=float(rng.uniform(-0.05, 0.05)),
            mirrored=bool(rng.integers(2)),
            pixel_m=float(rng.uniform(0.25e-6, 0.4e-6)),
        )
        bench = Bench(optics=optics)
        ways = [
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
        moves = 40e-6 * np.array(ways, dtype=float)
        seen = []
        for move in moves:
            tip_m = np.append(move, 0.0)
            start = optics.pixel_of(tip_m) + rng.uniform(-1.0, 1.0, 2)
            seen.append(fit_tip(bench.image(tip_m), bench.pipette, start))
        shifts = np.array([fit.pixel - seen[0].pixel for fit in seen])
        covariances = np.array([fit.covariance for fit in seen])
        told = fit_stage(moves, shifts, covariances).map.geometry
        true = StageMap(optics.mapping[:, :2], np.zeros((4, 4))).geometry
        assert told.handedness == true.handedness
        sizes = np.abs(np.array(told.pixel_size) / np.array(true.pixel_size) - 1.0)
        turned = abs((told.rotation - true.rotation + np.pi) % (2.0 * np.pi) - np.pi)
        worst = np.maximum(worst, [*sizes, turned, abs(told.skew - true.skew)])
    print(
        f"\ncalibration, {MOUNTINGS} mountings, ten tips each, ±40 µm, worst: pixel size "
        f"{100 * worst[:2].max():.3f} %, rotation {np.degrees(worst[2]):.4f}°, "
        f"skew {np.degrees(worst[3]):.4f}°"
    )
    assert worst[:2].max() < 1e-3
    assert np.degrees(worst[2]) < 0.05


def test_cell_outline():
    cell = Cell((5e-6, -4e-6, 0.0))
    bench = Bench(cell)
    middle = bench.optics.pixel_of(np.array(cell.centre_m))
    rows, times = [], []
    for _ in range(FRAMES):
        image = bench.image([bench.rng.uniform(20e-6, 60e-6), 0.0, 4e-6])
        near = middle + bench.rng.uniform(-20.0, 20.0, 2)
        found, took_s = timed(lambda i=image, n=near: find_cell(i, n, (20.0, 95.0)))
        times.append(took_s)
        axes = found.figures[2:4] * bench.optics.pixel_m - np.array([22e-6, 18e-6])
        rows.append([*(found.centre - middle), *(axes / bench.optics.pixel_m)])
    rms = np.sqrt((np.array(rows) ** 2).mean(axis=0))
    print(
        f"\ncell, px rms: centre {np.hypot(*rms[:2]):.2f}, half axes {rms[2]:.2f} and "
        f"{rms[3]:.2f}; {1e3 * np.median(times):.0f} ms"
    )
