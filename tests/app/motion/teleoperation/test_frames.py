"""Modes: switching moves nothing, the tip goes where it is asked, joints stay in their ranges."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotemina.app.motion.teleoperation.frames import FrameError
from rotemina.app.motion.teleoperation.linear_laws import LinearRate
from rotemina.app.motion.teleoperation.micro_nano_axis import HybridFrame, Saturation
from rotemina.app.motion.teleoperation.modes import Modes
from rotemina.app.motion.teleoperation.tip_pivot_modes import FineFrame, PivotFrame
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)
MODES = Modes(ROBOT)
RESOLUTION = {axis: ROBOT.axes[axis].sensor.resolution for axis in JOINTS}
CENTRE = dict(zip(JOINTS, CHAIN.centre.tolist(), strict=True))

places = st.tuples(*(st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 1.0])),) * 6).map(
    lambda shares: dict(
        zip(
            JOINTS,
            (CHAIN.lower + np.array(shares) * (CHAIN.upper - CHAIN.lower)).tolist(),
            strict=True,
        )
    )
)
shares = st.tuples(*(st.floats(0.0, 1.0),) * 3)


def somewhere(frame, shares):
    return {
        one.name: one.bounds.low + share * (one.bounds.high - one.bounds.low)
        for one, share in zip(frame.coordinates.values(), shares, strict=False)
    }


def tip_at(start, joints):
    return tip_position(CHAIN, np.array([{**start, **joints}[axis] for axis in JOINTS]))


@settings(max_examples=200, deadline=None)
@given(places, st.sampled_from(MODES.names), shares)
def test_beginning_a_mode_moves_nothing_and_no_joint_leaves_its_range(joints, name, shares):
    frame = MODES.begin(name, joints)
    begun = frame.joints(frame.start)
    assert set(begun) == set(frame.axes)
    for axis, at in begun.items():
        assert at == pytest.approx(joints[axis], abs=1e-3 * RESOLUTION[axis])
    for one in frame.coordinates.values():
        assert one.bounds.low <= one.start <= one.bounds.high
    after = frame.joints(somewhere(frame, shares))
    for axis, at in after.items():
        k = JOINTS.index(axis)
        assert CHAIN.lower[k] <= at <= CHAIN.upper[k]


@settings(max_examples=100, deadline=None)
@given(places, st.sampled_from(["hybrid", "fine"]), shares)
def test_the_tip_goes_where_the_coordinates_say(joints, name, shares):
    """But for the last 0.1 µm at the edge, where ends of joints hang together."""
    frame = MODES.begin(name, joints)
    asked = somewhere(frame, [0.01 + 0.98 * share for share in shares])
    tip = tip_at(joints, frame.joints(asked))
    near_edge = 1e-7 if min(shares) < 0.02 or max(shares) > 0.98 else 1e-12
    if name == "fine":
        near_edge = 1e-7
    assert tip == pytest.approx(list(asked.values()), abs=near_edge)


@pytest.mark.parametrize("name", MODES.names)
def test_speeds_are_the_derivative_of_the_joints(name):
    start = {**CENTRE, "thx": 3e-4, "zn": 45e-6}
    frame = MODES.begin(name, start)
    rng = np.random.default_rng(7)
    for _ in range(20):
        at = somewhere(frame, rng.uniform(0.3, 0.7, 3))
        if name == "hybrid":
            at["z"] = frame.start["z"] + rng.uniform(-60e-6, 60e-6)
        way = {
            one.name: rng.uniform(-1.0, 1.0) * one.bounds.max_speed
            for one in frame.coordinates.values()
        }
        h = 1e-5
        ahead, behind = (
            frame.joints({n: at[n] + sign * h * way[n] for n in at}) for sign in (1.0, -1.0)
        )
        speeds = frame.speeds(at, way)
        for axis in frame.axes:
            slope = (ahead[axis] - behind[axis]) / (2.0 * h)
            assert speeds[axis] == pytest.approx(slope, rel=1e-5, abs=1e-9)


@pytest.mark.parametrize("name", MODES.names)
def test_the_speed_that_a_mode_begins_with_is_that_of_the_axes(name):
    frame = MODES.begin(name, CENTRE)
    way = {one.name: 0.1 * one.bounds.max_speed for one in frame.coordinates.values()}
    again = frame.velocities(frame.speeds(frame.start, way))
    assert again == {n: pytest.approx(v, rel=1e-9) for n, v in way.items()}


# --- hybrid ---------------------------------------------------------------------------------------


def test_the_piezo_takes_what_fits_and_the_table_the_rest():
    frame = HybridFrame.at(CHAIN, CENTRE)
    small = frame.joints({**frame.start, "z": frame.start["z"] + 10e-6})
    assert small["zn"] - CENTRE["zn"] == pytest.approx(10e-6, rel=1e-5)
    assert small["z"] == pytest.approx(CENTRE["z"], abs=1e-11)
    large = {**frame.start, "z": frame.start["z"] + 1e-3}
    assert frame.joints(large)["zn"] == pytest.approx(65e-6)
    assert frame.joints(large)["z"] == pytest.approx(CENTRE["z"] + 1e-3 - 32.5e-6, abs=1e-10)
    assert frame.reserve(frame.start) == pytest.approx(1.0)
    assert frame.reserve(large) == 0.0


def test_the_way_back_is_the_way_there():
    frame = HybridFrame.at(CHAIN, CENTRE)
    heights = frame.start["z"] + np.linspace(-2e-4, 2e-4, 101)
    there = [frame.joints({**frame.start, "z": h}) for h in heights]
    back = [frame.joints({**frame.start, "z": h}) for h in heights[::-1]]
    assert there == back[::-1]


@pytest.mark.parametrize("start_zn", [0.0, 8e-6, 32.5e-6, 65e-6])
def test_taking_over_is_within_every_axis_acceleration_and_keeps_the_tip_s_speed(start_zn):
    start = {**CENTRE, "zn": start_zn}
    frame = HybridFrame.at(CHAIN, start)
    bounds = frame.coordinates["z"].bounds
    assert bounds.max_speed > 1e-3
    law = LinearRate(bounds, bounds.max_speed)
    law.start(frame.start["z"], 0.0, 0.0)
    dt, speeds, tips = 1e-3, [], []
    for k in range(600):
        motion = law.step(1.0 if k < 200 else -1.0, dt)
        at = {**frame.start, "z": motion.position}
        way = {"x": 0.0, "y": 0.0, "z": motion.velocity}
        speeds.append(frame.speeds(at, way))
        tips.append(tip_at(start, frame.joints(at)))
        assert speeds[-1]["z"] + speeds[-1]["zn"] * np.cos(start["thx"]) * np.cos(
            start["thy"]
        ) == pytest.approx(motion.velocity, rel=1e-9)
    for axis in ("z", "zn"):
        change = np.abs(np.diff([one[axis] for one in speeds])) / dt
        assert change.max() <= ROBOT.axes[axis].max_acceleration
        assert max(abs(one[axis]) for one in speeds) <= ROBOT.axes[axis].max_speed
    sideways = np.array(tips)[:, :2] - tips[0][:2]
    assert np.abs(sideways).max() < 1e-12


@given(st.floats(-1e-4, 1e-4), st.floats(0.0, 65e-6))
def test_the_saturation_rises_ends_in_the_range_and_can_be_inverted(u, place):
    saturation = Saturation(0.0, 65e-6)
    assert 0.0 <= saturation.place(u) <= 65e-6 * (1.0 + 1e-12)
    assert 0.0 <= saturation.slope(u) <= 1.0
    assert saturation.place(saturation.inverse(place)) == pytest.approx(place, abs=1e-15)
    h = 1e-10
    slope = (saturation.place(u + h) - saturation.place(u - h)) / (2.0 * h)
    assert saturation.slope(u) == pytest.approx(slope, abs=1e-4)


def test_near_the_table_s_end_the_piezo_still_has_its_way():
    top = {**CENTRE, "z": 0.08}
    bounds = HybridFrame.at(CHAIN, top).coordinates["z"]
    assert bounds.bounds.high - bounds.start == pytest.approx(16.25e-6, abs=1e-6)


# --- fine and pivot -------------------------------------------------------------------------------


def test_fine_reaches_46_um_and_tells_what_it_costs():
    corner = {**CENTRE, "thx": 0.0, "thy": 0.0}
    frame = FineFrame.at(CHAIN, corner)
    x = frame.coordinates["x"].bounds
    assert x.high - x.low == pytest.approx(46.5e-6, rel=2e-3)
    asked = {**frame.start, "x": x.low}
    assert frame.joints(asked)["thy"] == pytest.approx(1.16355e-3, rel=1e-6)
    assert frame.tilt(asked) == pytest.approx(1.16355e-3, rel=1e-6)
    assert frame.reserve(asked) == 0.0
    assert frame.tilt(frame.start) == 0.0


@settings(max_examples=100, deadline=None)
@given(places, shares)
def test_pivoting_leaves_the_tip(joints, shares):
    frame = PivotFrame.at(CHAIN, joints)
    turned = frame.joints(somewhere(frame, shares))
    # Where both z and zn stand at an end, or nearly, nothing makes up for what a tilt lifts.
    strayed = tip_at(joints, turned) - tip_at(joints, {})
    at_end = min(joints["z"], 0.08 - joints["z"]) < 6e-8
    assert np.abs(strayed).max() < (6e-8 if at_end else 1e-10)


def test_pivoting_needs_no_step_of_the_table_z():
    frame = PivotFrame.at(CHAIN, CENTRE)
    turned = frame.joints({"thx": 0.0, "thy": 1.1e-3})
    assert turned["z"] == CENTRE["z"]
    assert turned["zn"] != CENTRE["zn"]


def test_pivoting_is_bounded_by_the_tables_room_and_speed():
    cornered = {**CENTRE, "x": 0.0, "thy": 5e-4}
    bounds = PivotFrame.at(CHAIN, cornered).coordinates["thy"].bounds
    assert (bounds.low, bounds.high) == pytest.approx((5e-4, 1.16355e-3))
    assert bounds.max_speed == pytest.approx(2e-4, rel=2e-3)
    assert bounds.max_acceleration == pytest.approx(0.02, rel=2e-3)


# --- robots ---------------------------------------------------------------------------------------


def test_the_modes_go_round():
    assert MODES.names == ("micro", "nano", "hybrid", "fine", "pivot")
    seen = ["micro"]
    for _ in MODES.names:
        seen.append(MODES.after(seen[-1]))
    assert tuple(seen) == (*MODES.names, "micro")
    assert MODES.after("gone") == "micro"


@pytest.mark.parametrize(("name", "axes"), [("emps", "q"), ("picma", "p"), ("fsm", "m1 m2 m3")])
def test_a_robot_without_a_tip_has_its_axes(name, axes):
    robot = load_robot(name)
    modes = Modes(robot)
    assert modes.names == ("axes",)
    joints = {axis: robot.axes[axis].range[0] for axis in axes.split()}
    frame = modes.begin("axes", joints)
    assert frame.joints(frame.start) == joints
    assert frame.reserve(frame.start) is None
    assert frame.tilt(frame.start) is None
    with pytest.raises(FrameError, match=r"no such mode \(it needs the axes of the hybrid chain\)"):
        modes.begin("pivot", joints)
    with pytest.raises(FrameError, match=r"'up'.*use one of axes"):
        modes.begin("up", joints)


def test_a_robot_with_its_own_stages_has_a_mode_for_each():
    robot = replace(load_robot("fsm"), stages={"mirror": ("m1", "m2"), "piston": ("m3",)})
    assert Modes(robot).names == ("mirror", "piston")


@pytest.mark.parametrize("name", MODES.names)
def test_a_mode_does_not_begin_at_an_unknown_place(name):
    known = {axis: at for axis, at in CENTRE.items() if axis not in ("x", "thy")}
    with pytest.raises(FrameError, match="is not known; connect and home first"):
        MODES.begin(name, known)
