"""The pipette's appearance computed from the robot file."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.optics import compute_nominal_pixel_size_m, make_pipette
from rotemina.sim.robot import RobotMicroscope, RobotTool
from rotemina.sim.robot_files import load_robot

ROBOT = replace(
    load_robot("rotemina"),
    tool=RobotTool(approach_angle=np.pi / 6),
    microscope=RobotMicroscope(
        optical_axis=(0.0, 0.0, 1.0), pixel_size=6.7e-6, magnification=20.0, numerical_aperture=0.4
    ),
)


def test_pipette_follows_from_tool_and_microscope():
    pipette = make_pipette(ROBOT, 1.0)
    assert compute_nominal_pixel_size_m(ROBOT) == pytest.approx(0.335e-6)
    assert pipette.direction == 1.0
    assert pipette.depth_per_px == pytest.approx(0.335e-6 * np.tan(np.pi / 6))
    assert pipette.taper == pytest.approx(0.06 / np.cos(np.pi / 6))
    assert make_pipette(ROBOT, 1.0, 0.67e-6).radius == pytest.approx(pipette.radius / 2.0)


def test_file_without_a_pixel_size_is_refused():
    with pytest.raises(MicroscopeError, match="pixel_size and magnification"):
        make_pipette(replace(ROBOT, microscope=RobotMicroscope()), 0.0)
