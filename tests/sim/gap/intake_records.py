"""Records of a robot that moves, healthy and changed."""

import numpy as np
import pytest

from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


AXES = ("x", "thx", "zn")


def make_commands(axes=AXES, rows=4000, share=0.3, rate_hz=1000.0, **metadata):
    """Each axis there and back at its own pace, with a rest at the end."""
    time_s = np.arange(rows) / rate_hz
    signals = {}
    for number, axis in enumerate(axes, start=1):
        described = ROBOT.axes[axis]
        turn = np.sin(2.0 * np.pi * 0.4 * number * np.minimum(time_s, 0.85 * time_s[-1]))
        way = min(share * described.span, 2e-3)
        signals[axis, Tap.CMD] = sum(described.range) / 2.0 + way * turn
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def measured(effects=(), seed=0, **how):
    return simulate(ROBOT, effects, make_commands(**how), np.random.default_rng(seed))


def changed(record, taps=None, **metadata):
    """The record with some signals in place of its own; None takes one away."""
    signals = {channel: record.signal(*channel) for channel in record.columns} | dict(taps or {})
    kept = {channel: signal for channel, signal in signals.items() if signal is not None}
    return Record.from_signals(record.time_s, kept, record.units, dict(record.metadata) | metadata)


def timed(record, time_s):
    return Record(time_s, record.columns, np.array(record.values), record.units, record.metadata)


def refusal(*records, robot=ROBOT, names=()):
    with pytest.raises(GapError) as caught:
        check(robot, records, names)
    assert "\n" not in str(caught.value)
    return str(caught.value)
