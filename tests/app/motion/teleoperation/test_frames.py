"""Modes: switching causes no motion, the tip follows, and joints stay in their ranges."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotemina.app.errors import FrameError
from rotemina.app.motion.teleoperation import LinearRateLaw
from rotemina.app.motion.teleoperation.micro_nano_axis import HybridFrame
from rotemina.app.motion.teleoperation.modes import SteeringModes
from rotemina.app.motion.teleoperation.tip_pivot_modes import FineFrame, PivotFrame
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)
MODES = SteeringModes(ROBOT)
RESOLUTION = {axis: ROBOT.axes[axis].sensor.resolution for axis in JOINTS}
CENTRE = dict(zip(JOINTS, CHAIN.centre.tolist(), strict=True))

SPANS = CHAIN.upper - CHAIN.lower
JOINT_POSITIONS = st.tuples(
    *(st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 1.0])),) * 6
).map(lambda shares: dict(zip(JOINTS, CHAIN.lower + np.array(shares) * SPANS, strict=True)))
SHARES = st.tuples(*(st.floats(0.0, 1.0),) * 3)


def interpolate_coordinates(frame, shares):
    return {
        coordinate.name: coordinate.bounds.low
        + share * (coordinate.bounds.high - coordinate.bounds.low)
        for coordinate, share in zip(frame.coordinates.values(), shares, strict=False)
    }


def compute_tip(start, joints):
    return compute_tip_position(CHAIN, np.array([{**start, **joints}[axis] for axis in JOINTS]))


@settings(max_examples=200, deadline=None)
@given(JOINT_POSITIONS, st.sampled_from(MODES.names), SHARES)
def test_beginning_a_mode_moves_nothing_and_no_joint_leaves_its_range(joints, name, shares):
    frame = MODES.begin_mode(name, joints)
    initial_joints = frame.compute_joints(frame.start)
    assert set(initial_joints) == set(frame.axes)
    for axis, position in initial_joints.items():
        assert position == pytest.approx(joints[axis], abs=1e-3 * RESOLUTION[axis])
    for coordinate in frame.coordinates.values():
        assert coordinate.bounds.low <= coordinate.start <= coordinate.bounds.high
    joints_after = frame.compute_joints(interpolate_coordinates(frame, shares))
    for axis, position in joints_after.items():
        k = JOINTS.index(axis)
        assert CHAIN.lower[k] <= position <= CHAIN.upper[k]


@settings(max_examples=100, deadline=None)
@given(JOINT_POSITIONS, st.sampled_from(["hybrid", "fine"]), SHARES)
def test_the_tip_moves_to_the_commanded_coordinates(joints, name, shares):
    """Except for the last 0.1 µm at the edge, where the ends of joints depend on each other."""
    frame = MODES.begin_mode(name, joints)
    coordinates = interpolate_coordinates(frame, [0.01 + 0.98 * share for share in shares])
    tip = compute_tip(joints, frame.compute_joints(coordinates))
    tolerance = 1e-7 if min(shares) < 0.02 or max(shares) > 0.98 else 1e-12
    if name == "fine":
        tolerance = 1e-7
    assert tip == pytest.approx(list(coordinates.values()), abs=tolerance)


@pytest.mark.parametrize("name", MODES.names)
def test_speeds_are_the_derivative_of_the_joints(name):
    start = {**CENTRE, "thx": 3e-4, "zn": 45e-6}
    frame = MODES.begin_mode(name, start)
    rng = np.random.default_rng(7)
    for _ in range(20):
        coordinates = interpolate_coordinates(frame, rng.uniform(0.3, 0.7, 3))
        if name == "hybrid":
            coordinates["z"] = frame.start["z"] + rng.uniform(-60e-6, 60e-6)
        velocity = {
            coordinate.name: rng.uniform(-1.0, 1.0) * coordinate.bounds.max_speed
            for coordinate in frame.coordinates.values()
        }
        h = 1e-5
        ahead, behind = (
            frame.compute_joints(
                {key: coordinates[key] + sign * h * velocity[key] for key in coordinates}
            )
            for sign in (1.0, -1.0)
        )
        speeds = frame.compute_axis_speeds(coordinates, velocity)
        for axis in frame.axes:
            slope = (ahead[axis] - behind[axis]) / (2.0 * h)
            assert speeds[axis] == pytest.approx(slope, rel=1e-5, abs=1e-9)


# Hybrid


def test_the_piezo_moves_within_its_range_and_the_table_the_rest():
    frame = HybridFrame.begin_at(CHAIN, CENTRE)
    small = frame.compute_joints({**frame.start, "z": frame.start["z"] + 10e-6})
    assert small["zn"] - CENTRE["zn"] == pytest.approx(10e-6, rel=1e-5)
    assert small["z"] == pytest.approx(CENTRE["z"], abs=1e-11)
    large = {**frame.start, "z": frame.start["z"] + 1e-3}
    assert frame.compute_joints(large)["zn"] == pytest.approx(65e-6)
    assert frame.compute_joints(large)["z"] == pytest.approx(
        CENTRE["z"] + 1e-3 - 32.5e-6, abs=1e-10
    )
    assert frame.compute_reserve(frame.start) == pytest.approx(1.0)
    assert frame.compute_reserve(large) == 0.0


@pytest.mark.parametrize("start_zn", [0.0, 32.5e-6])
def test_the_transition_keeps_axis_limits_and_the_speed_of_the_tip(start_zn):
    start = {**CENTRE, "zn": start_zn}
    frame = HybridFrame.begin_at(CHAIN, start)
    bounds = frame.coordinates["z"].bounds
    assert bounds.max_speed > 1e-3
    law = LinearRateLaw(bounds, bounds.max_speed)
    law.start(frame.start["z"], 0.0, 0.0)
    dt, speeds, tips = 1e-3, [], []
    for k in range(600):
        motion = law.step(1.0 if k < 200 else -1.0, dt)
        coordinates = {**frame.start, "z": motion.position}
        velocity = {"x": 0.0, "y": 0.0, "z": motion.velocity}
        speeds.append(frame.compute_axis_speeds(coordinates, velocity))
        tips.append(compute_tip(start, frame.compute_joints(coordinates)))
        assert speeds[-1]["z"] + speeds[-1]["zn"] * np.cos(start["thx"]) * np.cos(
            start["thy"]
        ) == pytest.approx(motion.velocity, rel=1e-9)
    for axis in ("z", "zn"):
        change = np.abs(np.diff([axis_speeds[axis] for axis_speeds in speeds])) / dt
        assert change.max() <= ROBOT.axes[axis].max_acceleration
        assert max(abs(axis_speeds[axis]) for axis_speeds in speeds) <= ROBOT.axes[axis].max_speed
    sideways = np.array(tips)[:, :2] - tips[0][:2]
    assert np.abs(sideways).max() < 1e-12


def test_near_the_end_of_the_table_the_piezo_keeps_its_range():
    top_joints = {**CENTRE, "z": 0.08}
    z = HybridFrame.begin_at(CHAIN, top_joints).coordinates["z"]
    assert z.bounds.high - z.start == pytest.approx(16.25e-6, abs=1e-6)


# Fine and pivot


def test_fine_mode_reaches_46_um_and_reports_its_tilt():
    corner = {**CENTRE, "thx": 0.0, "thy": 0.0}
    frame = FineFrame.begin_at(CHAIN, corner)
    x = frame.coordinates["x"].bounds
    assert x.high - x.low == pytest.approx(46.5e-6, rel=2e-3)
    coordinates = {**frame.start, "x": x.low}
    assert frame.compute_joints(coordinates)["thy"] == pytest.approx(1.16355e-3, rel=1e-6)
    assert frame.compute_tilt(coordinates) == pytest.approx(1.16355e-3, rel=1e-6)
    assert frame.compute_reserve(coordinates) == 0.0
    assert frame.compute_tilt(frame.start) == 0.0


@settings(max_examples=100, deadline=None)
@given(JOINT_POSITIONS, SHARES)
def test_pivoting_keeps_the_tip_in_place(joints, shares):
    frame = PivotFrame.begin_at(CHAIN, joints)
    turned_joints = frame.compute_joints(interpolate_coordinates(frame, shares))
    # With both z and zn at or near an end, nothing can compensate the lift of a tilt.
    deviation = compute_tip(joints, turned_joints) - compute_tip(joints, {})
    at_end = min(joints["z"], 0.08 - joints["z"]) < 6e-8
    assert np.abs(deviation).max() < (6e-8 if at_end else 1e-10)


def test_pivoting_needs_no_step_of_the_z_table():
    frame = PivotFrame.begin_at(CHAIN, CENTRE)
    turned_joints = frame.compute_joints({"thx": 0.0, "thy": 1.1e-3})
    assert turned_joints["z"] == CENTRE["z"]
    assert turned_joints["zn"] != CENTRE["zn"]


def test_pivoting_is_bounded_by_range_and_speed_of_the_tables():
    joints = {**CENTRE, "x": 0.0, "thy": 5e-4}
    bounds = PivotFrame.begin_at(CHAIN, joints).coordinates["thy"].bounds
    assert (bounds.low, bounds.high) == pytest.approx((5e-4, 1.16355e-3))
    assert bounds.max_speed == pytest.approx(2e-4, rel=2e-3)
    assert bounds.max_acceleration == pytest.approx(0.02, rel=2e-3)


# Robots


@pytest.mark.parametrize(("name", "axes"), [("picma", "p"), ("fsm", "m1 m2 m3")])
def test_a_robot_without_a_tip_has_its_axes(name, axes):
    robot = load_robot(name)
    modes = SteeringModes(robot)
    assert modes.names == ("axes",)
    joints = {axis: robot.axes[axis].range[0] for axis in axes.split()}
    frame = modes.begin_mode("axes", joints)
    assert frame.compute_joints(frame.start) == joints
    assert frame.compute_reserve(frame.start) is None
    assert frame.compute_tilt(frame.start) is None
    with pytest.raises(FrameError, match=r"no such mode \(it needs the axes of the hybrid chain\)"):
        modes.begin_mode("pivot", joints)
    with pytest.raises(FrameError, match=r"'up'.*use one of axes"):
        modes.begin_mode("up", joints)


def test_a_robot_with_its_own_stages_has_a_mode_for_each():
    robot = replace(load_robot("fsm"), stages={"mirror": ("m1", "m2"), "piston": ("m3",)})
    assert SteeringModes(robot).names == ("mirror", "piston")


@pytest.mark.parametrize("name", MODES.names)
def test_a_mode_does_not_begin_at_an_unknown_position(name):
    known = {axis: position for axis, position in CENTRE.items() if axis not in ("x", "thy")}
    with pytest.raises(FrameError, match="is not known; connect and home first"):
        MODES.begin_mode(name, known)
