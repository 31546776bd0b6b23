"""Projection and blur of points in the image."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import SceneError
from rotemina.sim.kinematics import KinematicChain, compute_tip_position
from rotemina.sim.microscope.optics import MicroscopeOptics
from rotemina.sim.robot import RobotMicroscope
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")

directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)
mountings = st.builds(
    MicroscopeOptics,
    axis=directions,
    rotation_rad=st.floats(-pi, pi),
    skew_rad=st.floats(-0.2, 0.2),
    mirrored=st.booleans(),
    offset_px=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
points = st.tuples(*[st.floats(-2e-4, 2e-4)] * 3)


def test_an_inverted_microscope_shows_x_to_the_right_and_y_down():
    optics = MicroscopeOptics()
    pixels = optics.pixel_of(1e-6 * np.eye(3)) - optics.middle_px
    np.testing.assert_allclose(pixels, [[1 / 0.335, 0.0], [0.0, 1 / 0.335], [0.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(optics.depth_of(1e-6 * np.eye(3)), [0.0, 0.0, 1e-6], atol=1e-18)
    np.testing.assert_array_equal(optics.middle_px, [649.5, 514.5])


def test_a_view_from_above_shows_y_up():
    optics = MicroscopeOptics(axis=(0.0, 0.0, -2.0))
    assert optics.pixel_of(np.array([0.0, 1e-6, 0.0]))[1] < optics.middle_px[1]


def test_an_inclined_view_foreshortens_y_and_shows_height():
    tilt = pi / 6
    optics = MicroscopeOptics(axis=(0.0, np.sin(tilt), np.cos(tilt)))
    pixels = (optics.pixel_of(1e-6 * np.eye(3)) - optics.middle_px) * 0.335
    np.testing.assert_allclose(np.abs(pixels[:, 1]), [0.0, np.cos(tilt), np.sin(tilt)], atol=1e-12)


def test_rotation_mirror_and_skew_of_the_camera():
    rotated = MicroscopeOptics(rotation_rad=pi / 2)
    np.testing.assert_allclose(
        rotated.pixel_of(np.array([1e-6, 0.0, 0.0])) - rotated.middle_px,
        [0.0, 1 / 0.335],
        atol=1e-12,
    )
    assert np.linalg.det(MicroscopeOptics(mirrored=True).mapping[:, :2]) < 0.0
    skewed = MicroscopeOptics(skew_rad=0.1).mapping[:, :2] * 0.335e-6
    np.testing.assert_allclose(skewed[:, 0] @ skewed[:, 1], np.sin(0.1), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(skewed, axis=0), 1.0, atol=1e-12)


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_rotation_is_the_direction_of_the_x_axis_at_any_skew(mirrored):
    optics = MicroscopeOptics(rotation_rad=0.4, skew_rad=0.15, mirrored=mirrored)
    right = optics.mapping[:, 0] * optics.pixel_m * (-1.0 if mirrored else 1.0)
    np.testing.assert_allclose(right, [np.cos(0.4), np.sin(0.4)], atol=1e-12)


@given(mountings)
def test_the_view_is_a_right_handed_frame(optics):
    np.testing.assert_allclose(optics.view @ optics.view.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(optics.view) == pytest.approx(1.0)


@given(st.floats(0.0, 1e-3), st.floats(0.0, 1e-3))
def test_blur_grows_with_the_distance_from_focus(first, second):
    optics = MicroscopeOptics()
    near, far = sorted((first, second))
    assert optics.blur_px(near) <= optics.blur_px(far)
    assert optics.blur_px(-far) == optics.blur_px(far)


def test_blur_has_its_known_values_in_and_out_of_focus():
    optics = MicroscopeOptics()
    diffraction_px = 0.225 * 550e-9 / 0.4 / 0.335e-6
    assert optics.blur_px(0.0) ** 2 == pytest.approx(diffraction_px**2 + 1 / 12)
    edge = optics.blur_px(optics.depth_of_field_m / 2.0) ** 2 - 1 / 12
    assert edge == pytest.approx(2.0 * diffraction_px**2)
    assert optics.blur_px(1e-3) * 0.335e-6 == pytest.approx(0.45 * 0.4 * 1e-3, rel=1e-4)


def test_a_robot_file_gives_the_microscope():
    microscope = RobotMicroscope(
        optical_axis=(0.0, 1.0, 1.0),
        pixel_size=6.5e-6,
        magnification=40.0,
        numerical_aperture=0.6,
        depth_of_field=2e-6,
    )
    optics = MicroscopeOptics.of(replace(ROBOT, microscope=microscope), rotation_rad=0.1)
    assert optics.pixel_m == pytest.approx(1.625e-7)
    assert (optics.aperture, optics.depth_of_field_m) == (0.6, 2e-6)
    assert (optics.axis, optics.rotation_rad) == ((0.0, 1.0, 1.0), 0.1)
    chain = KinematicChain.of(ROBOT)
    middle = optics.pixel_of(compute_tip_position(chain, chain.centre))
    np.testing.assert_allclose(middle, optics.middle_px)


def test_a_missing_depth_of_field_follows_from_the_aperture():
    optics = MicroscopeOptics.of(replace(ROBOT, microscope=RobotMicroscope(numerical_aperture=0.8)))
    assert optics.depth_of_field_m == pytest.approx(550e-9 / 0.64)


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"axis": (0.0, 0.0, 0.0)}, "must be a direction"),
        ({"axis": (float("nan"), 0.0, 1.0)}, "must be a direction"),
        ({"pixel_m": 0.0}, "pixel_m = 0: must be more than 0"),
        ({"width": -3}, "width = -3"),
        ({"skew_rad": 1.0}, "skew 1 rad"),
    ],
)
def test_invalid_optics_are_refused(fields, reason):
    with pytest.raises(SceneError, match=reason):
        MicroscopeOptics(**fields)
