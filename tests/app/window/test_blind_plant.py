"""The stepped machine of the blind generator moves as in one run over the whole motion."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.blind import draw_case
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.robot_files import load_robot

sys.path.insert(0, str(Path(__file__).parent))
from blind_plant import STEPPED_EFFECTS, SteppedStage

ROBOT = load_robot("rotemina")
TICK_S = 5e-4
_SETTLING_TICKS = 800


@pytest.mark.parametrize("effect", STEPPED_EFFECTS)
def test_stepped_parts_move_as_in_one_run(effect):
    case = draw_case(ROBOT, "single", 6, effect)  # even seeds have no remainder
    assert case.label()["effects"][0]["effect"] == effect
    rng = np.random.default_rng(3)
    time_s = np.arange(2400) * TICK_S
    low, high = np.array([ROBOT.axes[name].range for name in case.axis_names]).T
    swing = np.sin(2 * np.pi * np.outer(time_s, [1.1, 2.3, 3.7]))
    commands = low + (high - low) * (0.5 + 0.42 * swing * np.linspace(1.0, 0.3, 2400)[:, None])
    one_run = case.machine.respond(SampledCommands(TICK_S, commands), 0)
    stage = SteppedStage(case.machine, TICK_S)
    memory = stage.make_memory_at_rest(commands[0])
    parts, start = [], 0
    while start < len(commands):
        end = start + int(rng.integers(1, 40))
        motion, memory = stage.advance(memory, commands[start:end])
        parts.append(motion)
        start = end
    travel = one_run.motion.max(axis=0) - one_run.motion.min(axis=0)
    # The single run starts settled on a bent spring; the stepped one settles first.
    error = np.abs(np.concatenate(parts) - one_run.motion)[_SETTLING_TICKS:].max(axis=0)
    assert (error < 1e-9 * travel).all(), error / travel
