"""Re-centring on the nominal plant: the true tip stays, also with set-points every 5 ms."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RecentringError
from rotemina.app.motion.teleoperation import plan_recentring
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position
from rotemina.sim.plant import Plant
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)
CENTRE = dict(zip(JOINTS, CHAIN.centre.tolist(), strict=True))
SAMPLE_S = 5e-5
BOARD_STEPS = np.array([1e-7, 1e-7, 1e-7, 2e-8, 2e-8, 1e-9])


def read_commands(start, trajectory):
    columns = [
        trajectory.signal(axis, Tap.CMD)
        if trajectory.has(axis, Tap.CMD)
        else np.full(len(trajectory.time_s), start[axis])
        for axis in JOINTS
    ]
    return np.stack(columns, axis=1)


def simulate_tip(commands, period_s, after_s=0.2, robot=ROBOT):
    """Return the path of the true tip (n, 3) on the plant, and its start (3,), m."""
    held_commands = np.concatenate(
        [commands, np.tile(commands[-1], (round(after_s / period_s), 1))]
    )
    held_commands = np.repeat(held_commands, round(period_s / SAMPLE_S), axis=0)
    plant = Plant.of(robot)
    motion, _ = plant.advance(
        plant.find_rest_state(0.0, held_commands[0]),
        np.arange(len(held_commands)) * SAMPLE_S,
        held_commands,
    )
    return compute_tip_position(CHAIN, motion.position), compute_tip_position(CHAIN, commands[0])


@pytest.mark.parametrize("zn", [0.0, 48.3e-6, 65e-6])
def test_the_true_tip_stays_within_50_nm_at_1_ms(zn):
    start = {**CENTRE, "zn": zn}
    plan = plan_recentring(CHAIN, start, 1e-3)
    assert dry_run(ROBOT, plan.trajectory, setpoint_period_s=1e-3).allowed
    commands = read_commands(start, plan.trajectory)
    assert commands[0] == pytest.approx(list(start.values()), abs=0.0)
    assert commands[-1, 5] == pytest.approx(CENTRE["zn"], abs=0.6e-7)
    for sent_commands in (commands, np.rint(commands / BOARD_STEPS) * BOARD_STEPS):
        path, start_tip = simulate_tip(sent_commands, 1e-3)
        deviation_m = np.abs(path - start_tip).max(axis=0)
        print(f"re-centring from zn = {1e6 * zn:.1f} µm: {1e9 * deviation_m[2]:.1f} nm along z")
        assert deviation_m[2] <= 20e-9
        assert deviation_m[:2].max() <= 40e-9
    assert plan.max_deviation_m == pytest.approx(deviation_m, abs=1.5e-9)


def test_tables_receive_whole_microsteps():
    start = {**CENTRE, "z": 0.0300123, "zn": 60e-6}
    trajectory = plan_recentring(CHAIN, start, 1e-3).trajectory
    steps = (trajectory.signal("z", Tap.CMD) - start["z"]) / 1e-7
    assert steps == pytest.approx(np.rint(steps), abs=1e-6)
    assert steps[-1] == pytest.approx(275.0)


def test_all_nano_joints_are_centred_and_the_tip_stays():
    start = {**CENTRE, "thx": 1e-4, "thy": 1.1e-3, "zn": 60e-6}
    plan = plan_recentring(CHAIN, start, 1e-3, ("thx", "thy", "zn"))
    assert dry_run(ROBOT, plan.trajectory, setpoint_period_s=1e-3).allowed
    commands = read_commands(start, plan.trajectory)
    assert commands[-1, 3:] == pytest.approx(CHAIN.centre[3:], abs=2e-6)
    path, start_tip = simulate_tip(commands, 1e-3)
    assert np.abs(path - start_tip).max() <= 12e-9


@pytest.mark.parametrize("axis", ["z", "zn"])
@pytest.mark.parametrize("frequency_ratio", [0.9, 1.1])
def test_a_resonance_off_by_ten_percent_still_holds_the_tip(axis, frequency_ratio):
    start = {**CENTRE, "zn": 65e-6}
    plan = plan_recentring(CHAIN, start, 1e-3)
    detuned_axis = replace(ROBOT.axes[axis], mass=ROBOT.axes[axis].mass / frequency_ratio**2)
    robot = replace(ROBOT, axes={**ROBOT.axes, axis: detuned_axis})
    path, start_tip = simulate_tip(read_commands(start, plan.trajectory), 1e-3, robot=robot)
    deviation_m = np.abs(path - start_tip)[:, 2].max()
    print(
        f"{axis} rings at {frequency_ratio:g} times the model: {1e9 * deviation_m:.1f} nm along z"
    )
    assert deviation_m <= 25e-9


def test_set_points_every_5_ms_hold_the_tip_within_160_nm():
    start = {**CENTRE, "zn": 65e-6}
    plan = plan_recentring(CHAIN, start, 5e-3)
    assert dry_run(ROBOT, plan.trajectory, setpoint_period_s=5e-3).allowed
    path, start_tip = simulate_tip(read_commands(start, plan.trajectory), 5e-3)
    deviation_m = np.abs(path - start_tip)[:, 2].max()
    print(f"re-centring with set-points of 5 ms: {1e9 * deviation_m:.1f} nm along z")
    assert deviation_m <= 160e-9
    assert plan.max_deviation_m[2] == pytest.approx(deviation_m, abs=1e-9)


def test_a_centred_robot_does_not_move():
    plan = plan_recentring(CHAIN, CENTRE, 1e-3)
    assert np.ptp(plan.trajectory.values, axis=0).max() == 0.0
    assert plan.max_deviation_m.max() < 1e-12


def test_impossible_requests_are_refused():
    with pytest.raises(RecentringError, match="z: must be one of thx, thy, zn"):
        plan_recentring(CHAIN, CENTRE, 1e-3, ("z",))
    with pytest.raises(RecentringError, match="no joint: must be one of"):
        plan_recentring(CHAIN, CENTRE, 1e-3, ())
    known = {axis: CENTRE[axis] for axis in ("x", "y", "z", "thy")}
    with pytest.raises(RecentringError, match="axis thx, zn is not known"):
        plan_recentring(CHAIN, known, 1e-3)
    with pytest.raises(OutOfLimitsError, match="axis z"):
        plan_recentring(CHAIN, {**CENTRE, "z": 0.0, "zn": 0.0}, 1e-3)
