"""The pipette as the robot file says it is seen."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.optics import nominal_pixel_m, pipette_of
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import Microscope, Tool

ROBOT = replace(
    load_robot("rotemina"),
    tool=Tool(approach_angle=np.pi / 6),
    microscope=Microscope(
        optical_axis=(0.0, 0.0, 1.0), pixel_size=6.7e-6, magnification=20.0, numerical_aperture=0.4
    ),
)


def test_the_pipette_follows_from_tool_and_microscope():
    pipette = pipette_of(ROBOT, 1.0)
    assert nominal_pixel_m(ROBOT) == pytest.approx(0.335e-6)
    assert pipette.direction == 1.0
    assert pipette.climb == pytest.approx(0.335e-6 * np.tan(np.pi / 6))
    assert pipette.taper == pytest.approx(0.06 / np.cos(np.pi / 6))
    assert pipette_of(ROBOT, 1.0, 0.67e-6).radius == pytest.approx(pipette.radius / 2.0)


def test_a_file_without_a_pixel_size_is_refused():
    with pytest.raises(MicroscopeError, match="pixel_size and magnification"):
        pipette_of(replace(ROBOT, microscope=Microscope()), 0.0)
