"""What the robot file says of microscope and tool, as the finder of the tip takes it."""

from math import pi

import numpy as np

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.sim.robot.model import Robot
from rotemina.sim.vision.pipette import Pipette

APPROACH = pi / 4  # rad, where a file says nothing
APERTURE = 0.4


def nominal_pixel_m(robot: Robot) -> float:
    """Return the size of a pixel in the specimen, m, by the robot file.

    Raises
    ------
    MicroscopeError
        If the file does not say it.
    """
    given = robot.microscope
    if given.pixel_size is None or given.magnification is None:
        raise MicroscopeError(
            f"robot {robot.name!r}: [microscope] pixel_size and magnification are missing; the "
            "tip's shape cannot be known without them"
        )
    return given.pixel_size / given.magnification


def pipette_of(robot: Robot, direction: float, pixel_m: float | None = None) -> Pipette:
    """Return the pipette as it is seen when its body leads in ``direction``, rad, in the picture.

    Parameters
    ----------
    robot : Robot
        Its ``[tool]`` and ``[microscope]``; the view is along z unless they say otherwise.
    direction : float
        From the tip, from columns towards rows; to within about 6°, found by itself.
    pixel_m : float, optional
        In the specimen; by default as the robot file says.
    """
    given = robot.microscope
    approach = robot.tool.approach_angle
    approach = APPROACH if approach is None else approach
    axis = np.array(given.optical_axis or (0.0, 0.0, 1.0))
    body = np.array([np.cos(approach), 0.0, np.sin(approach)])
    towards = float(body @ axis) / float(np.linalg.norm(axis))
    return Pipette.seen(
        direction,
        nominal_pixel_m(robot) if pixel_m is None else pixel_m,
        approach=float(np.arcsin(np.clip(towards, -1.0, 1.0))),
        aperture=given.numerical_aperture or APERTURE,
    )
