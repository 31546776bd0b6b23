"""Records too poor to distinguish causes."""

import numpy as np

from rotemina.sim.gap.compare import is_poor
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("emps")


def simulate_motion(robot, command, seed=0):
    time_s = np.arange(len(command)) * 1e-3
    commands = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    response = simulate(robot, robot.effects, commands)
    noise = 3e-3 * np.random.default_rng(seed).standard_normal(len(command))
    signals = {("q", Tap.CMD): command, ("q", Tap.U): response.signal("q", Tap.U) + noise}
    return Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "closed_loop"})


def test_a_few_moves_back_and_forth_are_not_a_sine():
    time_s = np.arange(20_000) * 1e-3
    ramp = np.clip(1.5 - np.abs(time_s % 5.0 - 2.5), 0.0, 1.0)
    small = 0.1 + 0.05 * ramp
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, small)]))
    sine = 0.1 + 0.02 * np.sin(2.0 * np.pi * 0.2 * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, sine)]))
    wide = 0.125 + 0.08 * np.sin(2.0 * np.pi * 0.2 * time_s)
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, wide)]))


def test_a_single_stroke_is_not_a_sine():
    """Few spectral lines contain a smooth stroke in a short record, but a sine fits it badly."""
    time_s = np.arange(10_000) * 1e-3
    stroke = 0.1 + 0.02 * np.exp(-(((time_s - 5.0) / 1.5) ** 2))
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, stroke)]))
    sine = 0.1 + 0.02 * np.sin(2.0 * np.pi * 0.13 * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, sine)]))


def test_a_sine_with_a_growing_start_is_one_sine():
    time_s = np.arange(4000) * 1e-3
    growing = 0.1 + 0.02 * np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_motion(ROBOT, growing)]))
