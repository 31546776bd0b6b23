"""The holding plate: time and memory on one core.

Run with ``pytest -s -o python_files='bench_*.py' tests/benchmarks/bench_plate.py``.
"""

import resource
import time
from math import inf

import numpy as np
from threadpoolctl import threadpool_limits

from rotemina.app.shell.theme import DARK
from rotemina.plugins.plate.canvas import Canvas
from rotemina.plugins.plate.coloured_quantities import QUANTITIES
from rotemina.plugins.plate.solution import solved
from rotemina.plugins.plate.surface_picture import static_picture
from rotemina.plugins.plate.words import pose_lines
from rotemina.sim.plate.modes import eigenmodes
from rotemina.sim.plate.statics import hold, solve
from rotemina.sim.plate.stress import deflection, surface_stress, von_mises
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.plate import Plate

FINE = 440  # divisions of a turn
REPEATS, FRAMES = 3, 100
SOLVE_S, MODES_S, FINE_S, FINE_GB, POSE_S = 2.0, 5.0, 60.0, 4.0, 0.01
LEAST_UNKNOWNS, LEAST_HZ = 200_000, 20.0
QUICK = {"FINE": 60, "REPEATS": 1, "FRAMES": 2, "LEAST_UNKNOWNS": 0, "LEAST_HZ": 0.0}
QUICK |= dict.fromkeys(("SOLVE_S", "MODES_S", "FINE_S", "FINE_GB", "POSE_S"), inf)


def best_of(repeats, work):
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        answer = work()
        times.append(time.perf_counter() - begin)
    return min(times), answer


def test_default_mesh():
    with threadpool_limits(1):
        solve_s, solutions = best_of(REPEATS, lambda: solve(hold(Plate())))
        modes_s, _ = best_of(REPEATS, lambda: eigenmodes(solutions.held, 0.04, 10))
    print(
        f"\ndefault mesh, {solutions.unknowns} unknowns: solve {solve_s:.2f} s (limit "
        f"{SOLVE_S:g}), ten modes {modes_s:.2f} s ({MODES_S:g})"
    )
    assert solve_s < SOLVE_S
    assert modes_s < MODES_S


def test_fine_mesh():
    with threadpool_limits(1):
        solve_s, solutions = best_of(1, lambda: solve(hold(Plate(), FINE)))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(
        f"\nfine mesh, {solutions.unknowns} unknowns: {solve_s:.1f} s ({FINE_S:g}), "
        f"{peak:.2f} GB ({FINE_GB:g})"
    )
    assert solutions.unknowns >= LEAST_UNKNOWNS
    assert solve_s < FINE_S
    assert peak < FINE_GB


def test_superposition():
    solutions = solve(hold(Plate()))
    pose = np.array([65e-6, 1e-3, 5e-4])

    def superpose():
        return deflection(solutions, pose), von_mises(surface_stress(solutions, pose))

    each_s, _ = best_of(FRAMES // 2, superpose)
    print(f"\none pose from unit solutions: {1e3 * each_s:.2f} ms ({1e3 * POSE_S:g})")
    assert each_s < POSE_S


def test_slider_frames(qtbot):
    """What a moved slider costs: superposition, words, and the picture on the screen."""
    answer = solved(load_robot("rotemina"), 120, lambda stage: None)
    canvas = Canvas(DARK)
    qtbot.addWidget(canvas)
    canvas.resize(800, 450)
    with qtbot.waitExposed(canvas):
        canvas.show()

    def frame():
        share = next(shares)
        pose = share * answer.ranges[:, 1]
        canvas.show_picture(static_picture(answer, pose, QUANTITIES[0], 1.0))
        canvas.repaint()
        return pose_lines(answer, pose)

    shares = iter(np.linspace(0.0, 1.0, FRAMES + 1))
    frame()
    begin, used = time.perf_counter(), time.process_time()
    for _ in range(FRAMES):
        frame()
    each_s, used_s = (time.perf_counter() - begin) / FRAMES, (time.process_time() - used) / FRAMES
    print(
        f"\na moved slider: {1 / each_s:.0f} frames/s ({LEAST_HZ:g}), "
        f"{1e3 * used_s:.1f} ms of one core"
    )
    assert 1 / each_s >= LEAST_HZ
