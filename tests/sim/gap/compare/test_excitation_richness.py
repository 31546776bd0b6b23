"""Records too poor to distinguish causes."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.compare import is_poor
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.robot_files import load_robot

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import simulate_effort

ROBOT = load_robot("emps")


def test_a_few_moves_back_and_forth_are_not_a_sine():
    time_s = np.arange(20_000) * 1e-3
    ramp = np.clip(1.5 - np.abs(time_s % 5.0 - 2.5), 0.0, 1.0)
    small = 0.1 + 0.05 * ramp
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, small)]))
    sine = 0.1 + 0.02 * np.sin(2.0 * np.pi * 0.2 * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, sine)]))
    wide = 0.125 + 0.08 * np.sin(2.0 * np.pi * 0.2 * time_s)
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, wide)]))


def test_a_single_stroke_is_not_a_sine():
    """Few spectral lines contain a smooth stroke in a short record, but a sine fits it badly."""
    time_s = np.arange(10_000) * 1e-3
    stroke = 0.1 + 0.02 * np.exp(-(((time_s - 5.0) / 1.5) ** 2))
    assert not is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, stroke)]))
    sine = 0.1 + 0.02 * np.sin(2.0 * np.pi * 0.13 * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, sine)]))


def test_a_sine_with_a_growing_start_is_one_sine():
    time_s = np.arange(4000) * 1e-3
    growing = 0.1 + 0.02 * np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * time_s)
    assert is_poor(Evidence.of(ROBOT, "q", [simulate_effort(ROBOT, growing)]))
