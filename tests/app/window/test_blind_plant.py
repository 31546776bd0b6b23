"""The blind generator's machine under way does what its run over a whole motion does."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.blind.case import draw_case
from rotemina.sim.blind.machine import Commands
from rotemina.sim.robot.file import load_robot

sys.path.insert(0, str(Path(__file__).parent))
from blind_plant import STEPPED, Going

ROBOT = load_robot("rotemina")
TICK_S = 5e-4
_SETTLED = 800  # ticks


@pytest.mark.parametrize("effect", STEPPED)
def test_parts_go_on_as_in_one_run(effect):
    case = draw_case(ROBOT, "single", 6, effect)  # of even seeds: no remainder
    assert case.label()["effects"][0]["effect"] == effect
    rng = np.random.default_rng(3)
    time_s = np.arange(2400) * TICK_S
    low, high = np.array([ROBOT.axes[name].range for name in case.names]).T
    swing = np.sin(2 * np.pi * np.outer(time_s, [1.1, 2.3, 3.7]))
    commands = low + (high - low) * (0.5 + 0.42 * swing * np.linspace(1.0, 0.3, 2400)[:, None])
    whole = case.machine.respond(Commands(TICK_S, commands), 0)
    going = Going(case.machine, TICK_S)
    memory = going.at_rest(commands[0])
    parts, done = [], 0
    while done < len(commands):
        end = done + int(rng.integers(1, 40))
        motion, memory = going.advance(memory, commands[done:end])
        parts.append(motion)
        done = end
    moved = whole.motion.max(axis=0) - whole.motion.min(axis=0)
    # The run has settled on a bent spring long ago; the other one settles now.
    off = np.abs(np.concatenate(parts) - whole.motion)[_SETTLED:].max(axis=0)
    assert (off < 1e-9 * moved).all(), off / moved
