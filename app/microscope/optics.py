"""Microscope and tool of the robot file, as the tip finder needs them."""

import re
from dataclasses import replace
from math import pi

import numpy as np

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.sim.messages import message
from rotemina.sim.microscope.optics import APERTURE as SIMULATED_APERTURE
from rotemina.sim.microscope.optics import MAGNIFICATION, PIXEL_SIZE_M
from rotemina.sim.microscope.scene import Pin
from rotemina.sim.robot.model import Robot
from rotemina.sim.vision.pipette import Pipette

APPROACH = pi / 4  # rad, where a file says nothing
APERTURE = 0.4


def nominal_pixel_m(robot: Robot, objective: str = "") -> float:
    """Return the size of a pixel in the specimen, m, by the robot file.

    An ``objective`` whose name tells its magnification counts instead of the file's.

    Raises
    ------
    MicroscopeError
        If the file does not say it.
    """
    given = robot.microscope
    if given.pixel_size is None or given.magnification is None:
        raise MicroscopeError(
            message(
                "engine",
                "robot {name}: [microscope] pixel_size and magnification are missing; they "
                "determine the tip's shape in the picture",
            ).fill(name=repr(robot.name))
        )
    return given.pixel_size / (magnification_of(objective) or given.magnification)


def as_simulated(robot: Robot) -> Robot:
    """Return a robot with the simulated microscope and tool."""
    given, angle = robot.microscope, robot.tool.approach_angle
    return replace(
        robot,
        microscope=replace(
            given,
            pixel_size=given.pixel_size or PIXEL_SIZE_M,
            magnification=given.magnification or MAGNIFICATION,
            numerical_aperture=given.numerical_aperture or SIMULATED_APERTURE,
        ),
        tool=replace(robot.tool, approach_angle=Pin().approach_rad if angle is None else angle),
    )


def magnification_of(objective: str) -> float | None:
    """Return the magnification in an objective's name: ``40x``, ``Plan 40x/0.6``."""
    found = re.search(r"(\d+(?:\.\d+)?)\s*[x×]", objective, re.IGNORECASE)
    return float(found[1]) if found and float(found[1]) > 0.0 else None


def objective_of(robot: Robot) -> str:
    """Return what the robot file's objective is called."""
    magnification = robot.microscope.magnification
    return "objective" if magnification is None else f"{magnification:g}x"


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
