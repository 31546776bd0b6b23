"""Constants that records agree on."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.output.constant_offsets import offsets
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


def evidence(*constants):
    """Records of zn, each read so much too high, with a swing beside it that no model makes."""
    records = []
    for number, constant in enumerate(constants):
        time_s = np.arange(800) * 0.005
        own = ROBOT.axes["zn"]
        command = np.full(800, sum(own.range) / 2.0 + number * 1e-6)
        noise = 3e-9 * np.random.default_rng(number).standard_normal(800)
        reading = command + own.offset + constant + noise
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        records.append(Record.from_signals(time_s, signals, {"zn": "m"}))
    return Evidence.of(ROBOT, "zn", records)


def test_a_constant_that_all_records_have_is_the_machines():
    found = offsets(evidence(1.00e-6, 1.02e-6, 0.98e-6))[Tap.MEAS]
    assert found.value == pytest.approx(1e-6, rel=0.01)
    assert 0.0 < found.deviation < 0.1e-6


def test_where_records_disagree_there_is_none():
    assert offsets(evidence(1e-6, -1e-6, 0.2e-6))[Tap.MEAS] is None


def test_a_single_record_agrees_with_itself_quarter_by_quarter():
    assert offsets(evidence(1e-6))[Tap.MEAS].value == pytest.approx(1e-6, rel=0.01)


def test_what_an_effect_accounts_for_is_no_offset():
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.1})
    (answer,) = evidence(0.0).response([gain])
    (nominal,) = evidence(0.0).response([])
    added = float(np.mean(answer[Tap.MEAS] - nominal[Tap.MEAS]))
    assert abs(added) > 1e-7
    assert offsets(evidence(added), [gain])[Tap.MEAS].value == pytest.approx(0.0, abs=2e-9)
