"""Where points are seen, and how blurred."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.microscope.errors import SceneError
from rotemina.sim.microscope.optics import Optics
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import Microscope

ROBOT = load_robot("rotemina")

directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)
mountings = st.builds(
    Optics,
    axis=directions,
    rotation_rad=st.floats(-pi, pi),
    skew_rad=st.floats(-0.2, 0.2),
    mirrored=st.booleans(),
    offset_px=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
points = st.tuples(*[st.floats(-2e-4, 2e-4)] * 3)


def test_an_inverted_microscope_sees_x_to_the_right_and_y_down():
    optics = Optics()
    seen = optics.pixel_of(1e-6 * np.eye(3)) - optics.middle_px
    np.testing.assert_allclose(seen, [[1 / 0.335, 0.0], [0.0, 1 / 0.335], [0.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(optics.depth_of(1e-6 * np.eye(3)), [0.0, 0.0, 1e-6], atol=1e-18)
    np.testing.assert_array_equal(optics.middle_px, [649.5, 514.5])


def test_from_above_y_goes_up():
    optics = Optics(axis=(0.0, 0.0, -2.0))
    assert optics.pixel_of(np.array([0.0, 1e-6, 0.0]))[1] < optics.middle_px[1]


def test_an_inclined_view_foreshortens_and_sees_height():
    tilt = pi / 6
    optics = Optics(axis=(0.0, np.sin(tilt), np.cos(tilt)))
    seen = (optics.pixel_of(1e-6 * np.eye(3)) - optics.middle_px) * 0.335
    np.testing.assert_allclose(np.abs(seen[:, 1]), [0.0, np.cos(tilt), np.sin(tilt)], atol=1e-12)


def test_how_the_camera_is_mounted():
    turned = Optics(rotation_rad=pi / 2)
    np.testing.assert_allclose(
        turned.pixel_of(np.array([1e-6, 0.0, 0.0])) - turned.middle_px, [0.0, 1 / 0.335], atol=1e-12
    )
    assert np.linalg.det(Optics(mirrored=True).mapping[:, :2]) < 0.0
    skewed = Optics(skew_rad=0.1).mapping[:, :2] * 0.335e-6
    np.testing.assert_allclose(skewed[:, 0] @ skewed[:, 1], np.sin(0.1), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(skewed, axis=0), 1.0, atol=1e-12)


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_rotation_is_where_the_x_axis_is_seen_whatever_the_skew(mirrored):
    optics = Optics(rotation_rad=0.4, skew_rad=0.15, mirrored=mirrored)
    right = optics.mapping[:, 0] * optics.pixel_m * (-1.0 if mirrored else 1.0)
    np.testing.assert_allclose(right, [np.cos(0.4), np.sin(0.4)], atol=1e-12)


@given(mountings)
def test_the_view_is_a_right_handed_frame(optics):
    np.testing.assert_allclose(optics.view @ optics.view.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(optics.view) == pytest.approx(1.0)


@given(st.floats(0.0, 1e-3), st.floats(0.0, 1e-3))
def test_blur_grows_with_the_distance_from_focus(one, other):
    optics = Optics()
    near, far = sorted((one, other))
    assert optics.blur_px(near) <= optics.blur_px(far)
    assert optics.blur_px(-far) == optics.blur_px(far)


def test_blur_in_focus_at_the_depth_of_field_and_far_away():
    optics = Optics()
    sharp = 0.225 * 550e-9 / 0.4 / 0.335e-6
    assert optics.blur_px(0.0) ** 2 == pytest.approx(sharp**2 + 1 / 12)
    edge = optics.blur_px(optics.depth_of_field_m / 2.0) ** 2 - 1 / 12
    assert edge == pytest.approx(2.0 * sharp**2)
    assert optics.blur_px(1e-3) * 0.335e-6 == pytest.approx(0.45 * 0.4 * 1e-3, rel=1e-4)


def test_a_robot_file_gives_the_microscope():
    told = Microscope(
        optical_axis=(0.0, 1.0, 1.0),
        pixel_size=6.5e-6,
        magnification=40.0,
        numerical_aperture=0.6,
        depth_of_field=2e-6,
    )
    optics = Optics.of(replace(ROBOT, microscope=told), rotation_rad=0.1)
    assert optics.pixel_m == pytest.approx(1.625e-7)
    assert (optics.aperture, optics.depth_of_field_m) == (0.6, 2e-6)
    assert (optics.axis, optics.rotation_rad) == ((0.0, 1.0, 1.0), 0.1)
    chain = Chain.of(ROBOT)
    middle = optics.pixel_of(tip_position(chain, chain.centre))
    np.testing.assert_allclose(middle, optics.middle_px)


def test_without_a_depth_of_field_it_follows_from_the_aperture():
    optics = Optics.of(replace(ROBOT, microscope=Microscope(numerical_aperture=0.8)))
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
def test_what_is_no_microscope(fields, reason):
    with pytest.raises(SceneError, match=reason):
        Optics(**fields)
