"""The shipped robot file contains the figures of the paper."""

from math import pi

import pytest

from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
MICRO, TILTS = ("x", "y", "z"), ("thx", "thy")
ARC_SECOND = pi / 648_000.0


@pytest.mark.parametrize(("axis", "stroke_m"), [("x", 0.055), ("y", 0.055), ("z", 0.080)])
def test_tables_have_the_published_figures(axis, stroke_m):
    table = ROBOT.axes[axis]
    assert table.range == (0.0, stroke_m)
    assert (table.steps_per_rev, table.pitch) == (200, 0.001)
    assert table.sensor.resolution == 1e-7
    assert table.repeatability == 2e-6


@pytest.mark.parametrize("axis", TILTS)
def test_tilts_have_the_published_figures(axis):
    tilt = ROBOT.axes[axis]
    assert tilt.span == pytest.approx(240.0 * ARC_SECOND, rel=1e-5)
    assert tilt.sensor.resolution == pytest.approx(tilt.span / 2**13, rel=1e-4)
    assert 2.0 * tilt.sensor.noise_rms * ROBOT.piezo_lever_arm == pytest.approx(35e-9, rel=0.05)


def test_nano_z_has_the_published_figures():
    zn = ROBOT.axes["zn"]
    assert zn.range == (0.0, 65e-6)
    assert zn.sensor.resolution == pytest.approx(65e-6 / 2**13, rel=1e-4)
    assert zn.sensor.resolution < 10e-9
    assert 3.0 * zn.sensor.noise_rms == pytest.approx(35e-9, rel=0.05)


def test_plate_and_pin_have_the_published_figures():
    plate = ROBOT.plate
    assert (plate.youngs_modulus, plate.poissons_ratio) == (211e9, 0.260)
    assert (plate.pin.youngs_modulus, plate.pin.poissons_ratio) == (204e9, 0.291)
