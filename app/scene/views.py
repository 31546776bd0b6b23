"""The viewpoints of the scene."""

from enum import StrEnum

import numpy as np

from rotemina.app.scene.robot_parts import make_cell
from rotemina.app.scene.scene import SceneCommand
from rotemina.sim.kinematics import KinematicChain, compute_tip_position


class SceneViewpoint(StrEnum):
    """The viewpoints that an operator can choose."""

    ISO = "iso"
    FRONT = "front"
    TOP = "top"
    BELOW = "below"
    CELL = "cell"


# Direction from the target to the eye, and its distance, m. TOP and BELOW deviate a little from the
# vertical, because the heading of a vertical view is undefined.
_EYE_OFFSETS = {
    SceneViewpoint.ISO: ((-0.75, -1.0, 0.6), 0.28),
    SceneViewpoint.FRONT: ((0.0, -1.0, 0.0), 0.30),
    SceneViewpoint.TOP: ((0.0, -1e-3, 1.0), 0.28),
    SceneViewpoint.BELOW: ((0.0, -1e-3, -1.0), 0.16),
    SceneViewpoint.CELL: ((-0.75, -1.0, 0.6), 3e-4),
}
# Vector from the cell to a target between the cell and the tip.
_CELL_VIEW_OFFSET_M = (22e-6, 0.0, 10e-6)
# Vector from the tip to a target between the tip and the tables.
_TABLE_VIEW_OFFSET_M = (0.0, 0.05, 0.0)
# Distance of the near clipping plane from the eye, as a fraction of the eye's distance.
_NEAR_PLANE_RATIO = 0.02


def make_view_command(chain: KinematicChain, view: SceneViewpoint) -> SceneCommand:
    """Return the command that moves a viewer's camera to a viewpoint.

    ``target`` is in scene coordinates, m, and ``eye`` is relative to ``target``.
    """
    direction, distance = _EYE_OFFSETS[view]
    target = compute_tip_position(chain, chain.centre)
    if view is SceneViewpoint.CELL:
        target = np.array(make_cell(chain).centre_m) + np.array(_CELL_VIEW_OFFSET_M)
    elif view in (SceneViewpoint.ISO, SceneViewpoint.FRONT, SceneViewpoint.TOP):
        target = target + np.array(_TABLE_VIEW_OFFSET_M)
    eye = np.array(direction) / np.linalg.norm(direction) * distance
    return {
        "type": "view",
        "target": target.tolist(),
        "eye": eye.tolist(),
        "near": _NEAR_PLANE_RATIO * distance,
    }
