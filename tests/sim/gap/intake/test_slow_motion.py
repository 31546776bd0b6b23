"""Slow motion: means over blocks in which the dynamics of the axis average out."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command, is_controlled
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
EMPS_AXIS = load_robot("emps").axes["q"]
TIME_S = np.arange(20_000) / 1000.0


def make_record(command, **others):
    signals = {("zn", Tap.CMD): command}
    signals |= {(axis, Tap.CMD): signal for axis, signal in others.items()}
    return Record.from_signals(TIME_S, signals, {axis: "m" for axis, _ in signals})


def make_slow_motion(command, **others):
    return SlowMotion.of(ROBOT.axes["zn"], make_record(command, **others), "zn")


def test_a_slow_ramp_is_kept_and_fast_motion_averages_out():
    ramp = 1e-6 * TIME_S
    slow_motion = make_slow_motion(ramp + 1e-6 * np.sin(2 * np.pi * 100.0 * TIME_S))
    assert np.ptp(slow_motion.command) == pytest.approx(np.ptp(ramp), rel=0.02)
    assert slow_motion.command.mean() == pytest.approx(0.0, abs=1e-12)
    assert slow_motion.average(3.0 * ramp) == pytest.approx(3.0 * make_slow_motion(ramp).command)


def test_there_is_no_slow_motion_in_fast_or_short_records():
    assert make_slow_motion(1e-6 * np.sin(2 * np.pi * 100.0 * TIME_S)) is None
    short = make_record(1e-6 * TIME_S).select_rows(slice(0, 100))
    assert SlowMotion.of(ROBOT.axes["zn"], short, "zn") is None


def test_only_other_axes_that_move_are_listed():
    slow_motion = make_slow_motion(1e-6 * TIME_S, x=1e-6 * TIME_S**2, y=np.full_like(TIME_S, 0.01))
    assert set(slow_motion.others) == {"x"}


def test_a_force_axis_follows_its_command_only_under_a_controller():
    open_loop = make_record(1e-6 * TIME_S)
    closed_loop = replace(open_loop, metadata={"mode": "closed_loop"})
    assert not follows_command(EMPS_AXIS, open_loop)
    assert follows_command(EMPS_AXIS, closed_loop)
    assert follows_command(ROBOT.axes["zn"], open_loop)
    # A stepper has no controller.
    assert not is_controlled(ROBOT.axes["x"], closed_loop)
