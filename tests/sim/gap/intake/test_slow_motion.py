"""Slow motion: means over blocks in which an axis' own dynamics have averaged out."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command, under_controller
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps").axes["q"]
TIME_S = np.arange(20_000) / 1000.0


def record(command, **others):
    signals = {("zn", Tap.CMD): command}
    signals |= {(axis, Tap.CMD): signal for axis, signal in others.items()}
    return Record.from_signals(TIME_S, signals, {axis: "m" for axis, _ in signals})


def slow(command, **others):
    return SlowMotion.of(ROBOT.axes["zn"], record(command, **others), "zn")


def test_a_slow_ramp_is_kept_and_what_is_fast_averages_out():
    ramp = 1e-6 * TIME_S
    found = slow(ramp + 1e-6 * np.sin(2 * np.pi * 100.0 * TIME_S))
    assert np.ptp(found.command) == pytest.approx(np.ptp(ramp), rel=0.02)
    assert found.command.mean() == pytest.approx(0.0, abs=1e-12)
    assert found.read(3.0 * ramp) == pytest.approx(3.0 * slow(ramp).command)


def test_there_is_none_where_all_is_fast_or_little_is_recorded():
    assert slow(1e-6 * np.sin(2 * np.pi * 100.0 * TIME_S)) is None
    short = record(1e-6 * TIME_S).part(slice(0, 100))
    assert SlowMotion.of(ROBOT.axes["zn"], short, "zn") is None


def test_only_other_axes_that_move_are_listed():
    found = slow(1e-6 * TIME_S, x=1e-6 * TIME_S**2, y=np.full_like(TIME_S, 0.01))
    assert set(found.others) == {"x"}


def test_a_force_is_followed_by_a_position_under_a_controller_only():
    open_loop = record(1e-6 * TIME_S)
    closed_loop = replace(open_loop, metadata={"mode": "closed_loop"})
    assert not follows_command(EMPS, open_loop)
    assert follows_command(EMPS, closed_loop)
    assert follows_command(ROBOT.axes["zn"], open_loop)
    assert not under_controller(ROBOT.axes["x"], closed_loop)  # a stepper has none
