"""What comes along with hysteresis: creep that closes next to nothing of the gap beside a loop."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.closed_share import closed
from rotemina.sim.gap.compare.companions import accompanied
from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.explanations import explain, untouched
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.thresholds import SMALL
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("picma")


def effect(name, formulation=None, **parameters):
    return AxisEffect(axis="p", id=name, formulation=formulation, parameters=parameters)


LOOP = effect("hysteresis", width=5e-6)
OTHER_LOOP = effect("hysteresis", "bouc_wen")
CREEP = effect("creep", rate=0.015, onset=0.1)
DRIFT = effect("thermal_drift", amplitude=2e-6, time_constant=30.0)
LAG = effect("amplifier_lag", time_constant=2e-3)


def swings(growth):
    """Return a step to the middle and swings about it, m, of 1 Hz that grow by a factor."""
    time_s = np.arange(4000) * 5e-3
    size = 12e-6 * np.linspace(1.0 / growth, 1.0, len(time_s))
    return time_s, 23e-6 + size * np.sin(2.0 * np.pi * time_s)


def evidence(*effects):
    records = []
    for number, growth in enumerate((1.0, 4.0)):
        time_s, command = swings(growth)
        commands = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"}, {})
        records.append(simulate(ROBOT, effects, commands, np.random.default_rng(number)))
    return Evidence.of(ROBOT, "p", records)


def told(*effects):
    """Return what an axis with such effects is explained by: hysteresis, and what joins it."""
    whole = evidence(*effects)
    account, raw = Account("p"), untouched(whole)
    account.begin(raw.score)
    alone = explain(whole, [AxisEffect(axis="p", id="hysteresis")])
    return raw, alone, *accompanied(whole, alone, {}, raw.score, account, jobs=1)


def test_creep_joins_the_hysteresis_beside_which_it_closes_next_to_nothing():
    raw, alone, best, ranked = told(LOOP, CREEP)
    assert closed(raw.score, alone.score) > 1.0 - SMALL  # by its share of the gap, no cause
    assert [one.id for one in best.causes] == ["hysteresis", "creep"]
    assert best.causes[1].parameters["rate"] == pytest.approx(0.015, rel=0.2)
    assert best.score < alone.score
    assert ranked["creep", None][0].effect == "creep"


@pytest.mark.parametrize("effects", [(LOOP,), (OTHER_LOOP,), (LOOP, DRIFT), (LOOP, LAG)])
def test_no_creep_joins_where_there_is_none(effects):
    _, alone, best, ranked = told(*effects)
    assert best is alone
    assert ranked == {}
