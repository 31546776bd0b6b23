"""Companions of hysteresis: creep, which closes almost nothing of the gap in addition to it."""

import numpy as np
import pytest

from rotemina.sim.gap.compare import accompanied, explain, untouched
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.limits import MIN_CAUSE_SHARE
from rotemina.sim.gap.result import Account, closed
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("picma")


def make_effect(name, formulation=None, **parameters):
    return AxisEffect(axis="p", id=name, formulation=formulation, parameters=parameters)


HYSTERESIS = make_effect("hysteresis", width=5e-6)
OTHER_HYSTERESIS = make_effect("hysteresis", "bouc_wen")
CREEP = make_effect("creep", rate=0.015, onset=0.1)
DRIFT = make_effect("thermal_drift", amplitude=2e-6, time_constant=30.0)
LAG = make_effect("amplifier_lag", time_constant=2e-3)


def make_swings(growth):
    """Return a step to the middle, then oscillations of 1 Hz around it that grow by a factor, m."""
    time_s = np.arange(4000) * 5e-3
    amplitude_m = 12e-6 * np.linspace(1.0 / growth, 1.0, len(time_s))
    return time_s, 23e-6 + amplitude_m * np.sin(2.0 * np.pi * time_s)


def make_evidence(*effects):
    records = []
    for number, growth in enumerate((1.0, 4.0)):
        time_s, command = make_swings(growth)
        commands = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"}, {})
        records.append(simulate(ROBOT, effects, commands, np.random.default_rng(number)))
    return Evidence.of(ROBOT, "p", records)


def explain_with_companions(*effects):
    """Return the explanations of an axis with effects: none, hysteresis, and with companions."""
    evidence = make_evidence(*effects)
    account, raw = Account("p"), untouched(evidence)
    account.begin(raw.score)
    hysteresis_only = explain(evidence, [AxisEffect(axis="p", id="hysteresis")])
    return (
        raw,
        hysteresis_only,
        *accompanied(evidence, hysteresis_only, {}, raw.score, account, jobs=1),
    )


def test_creep_is_added_to_hysteresis_although_it_closes_almost_nothing():
    raw, hysteresis_only, best, ranked = explain_with_companions(HYSTERESIS, CREEP)
    # Its share of the gap would be too small for a cause.
    assert closed(raw.score, hysteresis_only.score) > 1.0 - MIN_CAUSE_SHARE
    assert [cause.id for cause in best.causes] == ["hysteresis", "creep"]
    assert best.causes[1].parameters["rate"] == pytest.approx(0.015, rel=0.2)
    assert best.score < hysteresis_only.score
    assert ranked["creep", None][0].effect == "creep"


@pytest.mark.parametrize("effects", [(OTHER_HYSTERESIS,), (HYSTERESIS, DRIFT), (HYSTERESIS, LAG)])
def test_no_creep_is_added_where_there_is_none(effects):
    _, hysteresis_only, best, ranked = explain_with_companions(*effects)
    assert best is hysteresis_only
    assert ranked == {}
