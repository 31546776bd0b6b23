"""Records of a moving robot, valid and modified."""

import numpy as np
import pytest

from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake import check_records
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


AXES = ("x", "thx", "zn")


def make_commands(axes=AXES, rows=4000, share=0.3, rate_hz=1000.0, **metadata):
    """Return commands that move each axis back and forth at its own rate, then a rest."""
    time_s = np.arange(rows) / rate_hz
    signals = {}
    for number, axis in enumerate(axes, start=1):
        description = ROBOT.axes[axis]
        wave = np.sin(2.0 * np.pi * 0.4 * number * np.minimum(time_s, 0.85 * time_s[-1]))
        amplitude = min(share * description.span, 2e-3)
        signals[axis, Tap.CMD] = sum(description.range) / 2.0 + amplitude * wave
    return Record.from_signals(time_s, signals, {a: ROBOT.unit(a) for a in axes}, metadata)


def simulate_record(effects=(), seed=0, **options):
    return simulate(ROBOT, effects, make_commands(**options), np.random.default_rng(seed))


def modify_record(record, taps=None, **metadata):
    """Return a copy of a record with other signals; None removes a signal."""
    signals = {channel: record.signal(*channel) for channel in record.columns} | dict(taps or {})
    remaining = {channel: signal for channel, signal in signals.items() if signal is not None}
    return Record.from_signals(
        record.time_s, remaining, record.units, dict(record.metadata) | metadata
    )


def replace_times(record, time_s):
    return Record(time_s, record.columns, np.array(record.values), record.units, record.metadata)


def get_refusal(*records, robot=ROBOT, names=()):
    with pytest.raises(GapError) as error_info:
        check_records(robot, records, names)
    assert "\n" not in str(error_info.value)
    return str(error_info.value)
