"""Serves virtual boards with a case of the blind generator behind them, in a process of its own.

``blind_board.py SEED LABEL``: which effect it is goes into the file LABEL, and nowhere else.
"""

import json
import sys
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from blind_plant import STEPPED, BlindRun

from rotemina.app.cli.main import main
from rotemina.drivers.virtual_board import machine
from rotemina.sim.blind.case import draw_case
from rotemina.sim.robot.file import load_robot

#: A gap of fewer noise floors cannot shrink to a fifth and be told from noise.
LEAST_FLOORS = 30.0


def hidden_case(robot, seed):
    """Draw a single effect that can go on, on a piezo, whose gap is well above the noise."""
    rng = np.random.default_rng(seed)
    while True:
        effect = str(rng.choice(STEPPED))
        case = draw_case(robot, "single", int(rng.integers(1 << 30)), effect)
        (hidden,) = case.label()["effects"]
        piezo = robot.axes[hidden["axis"]].kind == "piezo"
        if case.remainder is not None:  # it acts over whole motions, and cannot go on
            continue
        if hidden["effect"] in STEPPED and piezo and hidden["floors"] >= LEAST_FLOORS:
            return case


if __name__ == "__main__":
    robot = load_robot("rotemina")
    case = hidden_case(robot, int(sys.argv[1]))
    Path(sys.argv[2]).write_text(json.dumps(case.label()), "utf-8")

    def run(_, tick_s, seed, position):
        """Stand in for the boards' own plant."""
        return BlindRun(robot, case, tick_s, seed, position)

    machine.PlantRun = partial(run)
    sys.exit(main(["board", "--robot", "rotemina", "--position-known"]))
