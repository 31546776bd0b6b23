"""The viewpoints of the scene."""

from enum import StrEnum

import numpy as np

from rotemina.app.scene.robot_parts import cell_of
from rotemina.app.scene.scene import Command
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position


class View(StrEnum):
    """The views that a button leads to."""

    ISO = "iso"
    FRONT = "front"
    TOP = "top"
    BELOW = "below"
    CELL = "cell"


# Which way the eye stands from what it looks at, and how far, m. Exactly upright has no heading.
_EYES = {
    View.ISO: ((-0.75, -1.0, 0.6), 0.28),
    View.FRONT: ((0.0, -1.0, 0.0), 0.30),
    View.TOP: ((0.0, -1e-3, 1.0), 0.28),
    View.BELOW: ((0.0, -1e-3, -1.0), 0.16),
    View.CELL: ((-0.75, -1.0, 0.6), 3e-4),
}
_BESIDE_CELL = (22e-6, 0.0, 10e-6)  # m, from the cell: between it and the tip
_TABLES = (0.0, 0.05, 0.0)  # m, from the tip: between it and the tables
_NEAREST = 0.02  # of the distance: what is closer to the eye is not drawn


def look(chain: Chain, view: View) -> Command:
    """Return the command that turns the viewer's camera there; ``eye`` is seen from ``target``."""
    direction, distance = _EYES[view]
    middle = tip_position(chain, chain.centre)
    if view is View.CELL:
        middle = np.array(cell_of(chain).centre_m) + np.array(_BESIDE_CELL)
    elif view in (View.ISO, View.FRONT, View.TOP):
        middle = middle + np.array(_TABLES)
    eye = np.array(direction) / np.linalg.norm(direction) * distance
    return {
        "type": "view",
        "target": middle.tolist(),
        "eye": eye.tolist(),
        "near": _NEAREST * distance,
    }
