"""Constant offsets on which records agree."""

import numpy as np
import pytest

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.output import estimate_offsets
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_evidence(*constants):
    """Return evidence of zn at rest, in which each reading is too high by a constant."""
    records = []
    for number, constant in enumerate(constants):
        time_s = np.arange(800) * 0.005
        axis = ROBOT.axes["zn"]
        command = np.full(800, sum(axis.range) / 2.0 + number * 1e-6)
        noise = 3e-9 * np.random.default_rng(number).standard_normal(800)
        reading = command + axis.offset + constant + noise
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        records.append(Record.from_signals(time_s, signals, {"zn": "m"}))
    return Evidence.of(ROBOT, "zn", records)


def test_a_constant_in_all_records_is_an_offset_of_the_machine():
    offset = estimate_offsets(make_evidence(1.00e-6, 1.02e-6, 0.98e-6))[Tap.MEAS]
    assert offset.value == pytest.approx(1e-6, rel=0.01)
    assert 0.0 < offset.deviation < 0.1e-6


def test_records_that_disagree_give_no_offset():
    assert estimate_offsets(make_evidence(1e-6, -1e-6, 0.2e-6))[Tap.MEAS] is None


def test_the_quarters_of_a_single_record_agree():
    assert estimate_offsets(make_evidence(1e-6))[Tap.MEAS].value == pytest.approx(1e-6, rel=0.01)


def test_a_constant_that_an_effect_explains_is_not_an_offset():
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.1})
    (response,) = make_evidence(0.0).response([gain])
    (nominal,) = make_evidence(0.0).response([])
    change = float(np.mean(response[Tap.MEAS] - nominal[Tap.MEAS]))
    assert abs(change) > 1e-7
    assert estimate_offsets(make_evidence(change), [gain])[Tap.MEAS].value == pytest.approx(
        0.0, abs=2e-9
    )
