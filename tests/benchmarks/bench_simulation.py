"""The nominal simulation: six axes, compared with ``scipy.signal.dlsim`` on the same matrices.

Limit: at least 20 times faster.
"""

import time
from statistics import median

import numpy as np
from scipy.linalg import block_diag, expm
from scipy.signal import dlsim

from rotemina.sim.plant import Plant
from rotemina.sim.robot_files import load_robot

RATE_HZ, ROWS, TURNS = 2000.0, 20_000, 7
QUICK = {"ROWS": 2000, "TURNS": 1}


def test_nominal_simulation_compared_with_dlsim():
    robot = load_robot("rotemina")
    plant = Plant.of(robot)
    time_s = np.arange(ROWS) / RATE_HZ
    centres = np.array([sum(axis.range) / 2 for axis in robot.axes.values()])
    spans = np.array([axis.span for axis in robot.axes.values()])
    wave = np.sin(2 * np.pi * np.outer(time_s, [1.0, 1.5, 2.0, 3.0, 4.0, 5.0]))
    command = centres + 0.05 * spans * wave
    system = make_discrete_system(plant)
    inputs = plant.compute_open_loop_inputs(command)
    order = [plant.axes.index(name) for group in plant.groups for name in group.axes]
    start = make_dlsim_start(plant, command[0])

    def run_ours():
        return plant.advance(plant.find_rest_state(0.0, command[0]), time_s, command)[0].position

    def run_dlsim():
        return dlsim(system, inputs[:, order], x0=start)[1]

    gap = np.abs(run_ours()[:, order] - run_dlsim()) / spans[order]
    assert gap.max() < 1e-9
    seconds = {"ours": [], "dlsim": []}
    for _ in range(TURNS):
        for name, run in (("ours", run_ours), ("dlsim", run_dlsim)):
            begin = time.perf_counter()
            run()
            seconds[name].append(time.perf_counter() - begin)
    ratios = [b / a for a, b in zip(seconds["ours"], seconds["dlsim"], strict=True)]
    print(
        f"\nsix axes, {ROWS} rows: {1e3 * median(seconds['ours']):.1f} ms, dlsim "
        f"{1e3 * median(seconds['dlsim']):.1f} ms; ratio {median(ratios):.0f} "
        f"({min(ratios):.0f} to {max(ratios):.0f}, {TURNS} pairs; limit 20)"
    )


def make_discrete_system(plant):
    """Return the same exact discretisation, with all groups in one system."""
    states, inputs = [], []
    for group in plant.groups:
        exact = expm(group.generator / RATE_HZ)
        rows = 2 * group.size
        states.append(exact[:rows, :rows])
        inputs.append(exact[:rows, rows : rows + group.size])
    a, b = block_diag(*states), block_diag(*inputs)
    sizes = [group.size for group in plant.groups]
    c = block_diag(*[np.eye(size, 2 * size) for size in sizes])
    return a, b, c, np.zeros((sum(sizes), sum(sizes))), 1.0 / RATE_HZ


def make_dlsim_start(plant, command):
    position = plant.find_rest_state(0.0, command).position[0]
    parts = []
    for group in plant.groups:
        columns = [plant.axes.index(name) for name in group.axes]
        parts.append(np.concatenate([position[columns], np.zeros(len(columns))]))
    return np.concatenate(parts)
