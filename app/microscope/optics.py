"""Converts the microscope and tool of a robot file into the form that the tip search needs."""

import re
from dataclasses import replace
from math import pi

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.sim.microscope import (
    DEFAULT_APERTURE as SIMULATED_APERTURE,
    DEFAULT_MAGNIFICATION,
    DEFAULT_PIXEL_SIZE_M,
    TaperedPin,
)
from rotemina.sim.robot import Robot
from rotemina.sim.vision import Pipette

# Approach angle and numerical aperture for robot files that do not state them.
DEFAULT_APPROACH_RAD = pi / 4
DEFAULT_APERTURE = 0.4


def compute_nominal_pixel_size_m(robot: Robot, objective: str = "") -> float:
    """Compute the size of a pixel in the specimen, m, from the robot file.

    If the name of the ``objective`` contains a magnification, that replaces the one in the file.

    Raises
    ------
    MicroscopeError
        If the file lacks pixel size or magnification.
    """
    optics = robot.microscope
    if optics.pixel_size is None or optics.magnification is None:
        raise MicroscopeError(
            "robot {name}: [microscope] pixel_size and magnification are missing; they "
            "determine the tip's shape in the picture",
            name=repr(robot.name),
        )
    return optics.pixel_size / (parse_magnification(objective) or optics.magnification)


def with_simulated_optics(robot: Robot) -> Robot:
    """Return a copy of a robot, completed with the data of the simulated microscope and tool."""
    optics, angle = robot.microscope, robot.tool.approach_angle
    return replace(
        robot,
        microscope=replace(
            optics,
            pixel_size=optics.pixel_size or DEFAULT_PIXEL_SIZE_M,
            magnification=optics.magnification or DEFAULT_MAGNIFICATION,
            numerical_aperture=optics.numerical_aperture or SIMULATED_APERTURE,
        ),
        tool=replace(
            robot.tool, approach_angle=TaperedPin().approach_rad if angle is None else angle
        ),
    )


def parse_magnification(objective: str) -> float | None:
    """Return the magnification in an objective's name, such as ``40x`` or ``Plan 40x/0.6``.

    Return None if the name contains none.
    """
    match = re.search(r"(\d+(?:\.\d+)?)\s*[x×]", objective, re.IGNORECASE)
    return float(match[1]) if match and float(match[1]) > 0.0 else None


def make_objective_name(robot: Robot) -> str:
    """Return a name for the objective of the robot file."""
    magnification = robot.microscope.magnification
    return "objective" if magnification is None else f"{magnification:g}x"


def make_pipette(robot: Robot, direction: float, pixel_m: float | None = None) -> Pipette:
    """Return the pipette as the microscope sees it.

    Parameters
    ----------
    robot : Robot
        Its ``[tool]`` and ``[microscope]`` are used; the default optical axis is z.
    direction : float
        Direction from the tip along the body in the picture, rad: the angle from the +column
        direction towards the +row direction. An accuracy of about 6° is enough for the search.
    pixel_m : float, optional
        Size of a pixel in the specimen, m; by default that of the robot file.
    """
    optics = robot.microscope
    approach_rad = robot.tool.approach_angle
    approach_rad = DEFAULT_APPROACH_RAD if approach_rad is None else approach_rad
    optical_axis = np.array(optics.optical_axis or (0.0, 0.0, 1.0))
    body = np.array([np.cos(approach_rad), 0.0, np.sin(approach_rad)])
    # Component of the body's direction along the optical axis.
    axial = float(body @ optical_axis) / float(np.linalg.norm(optical_axis))
    return Pipette.from_optics(
        direction,
        compute_nominal_pixel_size_m(robot) if pixel_m is None else pixel_m,
        approach=float(np.arcsin(np.clip(axial, -1.0, 1.0))),
        aperture=optics.numerical_aperture or DEFAULT_APERTURE,
    )
