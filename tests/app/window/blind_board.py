"""Serves virtual boards that simulate a case of the blind generator, as a separate process.

``blind_board.py SEED LABEL``: the hidden effect is written only to the file LABEL.
"""

import json
import sys
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from blind_plant import STEPPED_EFFECTS, BlindRun

from rotemina.app.cli.main import main
from rotemina.drivers.virtual_board import machine
from rotemina.sim.blind import draw_case
from rotemina.sim.robot_files import load_robot

#: A smaller gap could not be distinguished from noise after shrinking to a fifth.
MIN_FLOOR_RATIO = 30.0


def draw_hidden_case(robot, seed):
    """Draw a case with one effect on a piezo, far above the noise, that can be stepped."""
    rng = np.random.default_rng(seed)
    while True:
        effect = str(rng.choice(STEPPED_EFFECTS))
        case = draw_case(robot, "single", int(rng.integers(1 << 30)), effect)
        (hidden,) = case.label()["effects"]
        piezo = robot.axes[hidden["axis"]].kind == "piezo"
        # A remainder acts over whole motions, so it cannot be simulated stepwise.
        if case.remainder is not None:
            continue
        if hidden["effect"] in STEPPED_EFFECTS and piezo and hidden["floors"] >= MIN_FLOOR_RATIO:
            return case


if __name__ == "__main__":
    robot = load_robot("rotemina")
    case = draw_hidden_case(robot, int(sys.argv[1]))
    Path(sys.argv[2]).write_text(json.dumps(case.label()), "utf-8")

    def run(_, tick_s, seed, position):
        """Replace the plant of the boards."""
        return BlindRun(robot, case, tick_s, seed, position)

    machine.PlantRun = partial(run)
    sys.exit(main(["board", "--robot", "rotemina", "--position-known"]))
