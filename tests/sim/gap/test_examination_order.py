"""The order in which axes are examined, on short records of the simulator."""

import numpy as np
import pytest

from rotemina.sim.gap.examination_order import examination_order
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(2000) / 500.0
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4, "shape": 1.4})


def coupling(axis, from_axis, k):
    return AxisEffect(axis=axis, id="cross_coupling", from_axis=from_axis, parameters={"k": k})


def evidences(effects, rates_hz, taps=(Tap.REF, Tap.MEAS)):
    """Return what records of axes that swing, each at its own rate, say of each of them."""
    signals, units = {}, {}
    for name, rate_hz in rates_hz.items():
        own = ROBOT.axes[name]
        swing = 0.2 * own.span * np.sin(2 * np.pi * rate_hz * TIME_S)
        signals[name, Tap.CMD] = sum(own.range) / 2 + swing
        units[name] = own.unit
    commands = Record.from_signals(TIME_S, signals, units)
    rng = np.random.default_rng(0)
    whole = [simulate(ROBOT, effects, commands, rng) for _ in range(2)]
    records = [
        Record.from_signals(
            one.time_s,
            {(name, tap): one.signal(name, tap) for name in rates_hz for tap in (Tap.CMD, *taps)},
            one.units,
        )
        for one in whole
    ]
    return {name: Evidence.of(ROBOT, name, records) for name in rates_hz}


@pytest.mark.parametrize("taps", [(Tap.REF, Tap.MEAS), (Tap.MEAS,)], ids=["reference", "sensor"])
def test_an_axis_comes_after_the_one_whose_motion_moves_it(taps):
    found = evidences([HYSTERESIS, coupling("zn", "thx", 0.02)], {"thx": 0.7, "zn": 1.3}, taps)
    assert examination_order(found, ["zn", "thx"]) == ["thx", "zn"]


def test_a_chain_of_couplings_is_followed_from_its_begin():
    effects = [HYSTERESIS, coupling("zn", "thx", 0.02), coupling("thy", "zn", 3.0)]
    found = evidences(effects, {"thx": 0.7, "zn": 1.3, "thy": 2.1})
    assert examination_order(found, ["thy", "zn", "thx"]) == ["thx", "zn", "thy"]


def test_of_axes_that_move_each_other_the_largest_gap_comes_first():
    effects = [coupling("thx", "zn", 2.0), coupling("zn", "thx", 0.02)]
    found = evidences(effects, {"thx": 0.7, "zn": 1.3})
    assert examination_order(found, ["zn", "thx"]) == ["zn", "thx"]
    assert examination_order(found, ["thx", "zn"]) == ["thx", "zn"]


def test_gaps_of_their_own_keep_their_order():
    own = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6, "shape": 1.4})
    found = evidences([HYSTERESIS, own], {"thx": 0.7, "zn": 1.3})
    assert examination_order(found, ["zn", "thx"]) == ["zn", "thx"]
    assert examination_order(found, ["thx", "zn"]) == ["thx", "zn"]


def test_records_of_one_axis_each_say_nothing_of_another():
    found = {
        **evidences([HYSTERESIS], {"thx": 0.7}),
        **evidences([coupling("zn", "thx", 0.02)], {"zn": 1.3}),
    }
    assert examination_order(found, ["zn", "thx"]) == ["zn", "thx"]
