"""The order in which axes are examined, on short records of the simulator."""

import numpy as np
import pytest

from rotemina.sim.gap.examination import order_axes
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(2000) / 500.0
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4, "shape": 1.4})


def make_coupling(axis, from_axis, k):
    return AxisEffect(axis=axis, id="cross_coupling", from_axis=from_axis, parameters={"k": k})


def make_evidence(effects, rates_hz, taps=(Tap.REF, Tap.MEAS)):
    """Return the evidence of each axis from records in which all oscillate at different rates."""
    signals, units = {}, {}
    for name, rate_hz in rates_hz.items():
        axis = ROBOT.axes[name]
        swing = 0.2 * axis.span * np.sin(2 * np.pi * rate_hz * TIME_S)
        signals[name, Tap.CMD] = sum(axis.range) / 2 + swing
        units[name] = axis.unit
    commands = Record.from_signals(TIME_S, signals, units)
    rng = np.random.default_rng(0)
    full_records = [simulate(ROBOT, effects, commands, rng) for _ in range(2)]
    records = [
        Record.from_signals(
            record.time_s,
            {
                (name, tap): record.signal(name, tap)
                for name in rates_hz
                for tap in (Tap.CMD, *taps)
            },
            record.units,
        )
        for record in full_records
    ]
    return {name: Evidence.of(ROBOT, name, records) for name in rates_hz}


@pytest.mark.parametrize("taps", [(Tap.REF, Tap.MEAS), (Tap.MEAS,)], ids=["reference", "sensor"])
def test_an_axis_comes_after_the_axis_that_couples_into_it(taps):
    evidence = make_evidence(
        [HYSTERESIS, make_coupling("zn", "thx", 0.02)], {"thx": 0.7, "zn": 1.3}, taps
    )
    assert order_axes(evidence, ["zn", "thx"]) == ["thx", "zn"]


def test_a_chain_of_couplings_is_followed_from_its_start():
    effects = [HYSTERESIS, make_coupling("zn", "thx", 0.02), make_coupling("thy", "zn", 3.0)]
    evidence = make_evidence(effects, {"thx": 0.7, "zn": 1.3, "thy": 2.1})
    assert order_axes(evidence, ["thy", "zn", "thx"]) == ["thx", "zn", "thy"]


def test_mutually_coupled_axes_keep_their_order():
    effects = [make_coupling("thx", "zn", 2.0), make_coupling("zn", "thx", 0.02)]
    evidence = make_evidence(effects, {"thx": 0.7, "zn": 1.3})
    assert order_axes(evidence, ["zn", "thx"]) == ["zn", "thx"]
    assert order_axes(evidence, ["thx", "zn"]) == ["thx", "zn"]


def test_independent_gaps_keep_their_order():
    zn_hysteresis = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6, "shape": 1.4})
    evidence = make_evidence([HYSTERESIS, zn_hysteresis], {"thx": 0.7, "zn": 1.3})
    assert order_axes(evidence, ["zn", "thx"]) == ["zn", "thx"]
    assert order_axes(evidence, ["thx", "zn"]) == ["thx", "zn"]


def test_records_of_single_axes_show_no_coupling():
    evidence = {
        **make_evidence([HYSTERESIS], {"thx": 0.7}),
        **make_evidence([make_coupling("zn", "thx", 0.02)], {"zn": 1.3}),
    }
    assert order_axes(evidence, ["zn", "thx"]) == ["zn", "thx"]
