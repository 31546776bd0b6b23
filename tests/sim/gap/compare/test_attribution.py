"""Which of the model's own parameters is a cause, beside rivals that are fitted without it."""

import numpy as np

from rotemina.sim.gap.compare import attribution
from rotemina.sim.gap.compare.attribution import attributed, without_own
from rotemina.sim.gap.compare.explanations import explain, untouched
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

GAIN, RESONANCE = "gain_error", "resonance_mismatch"
ROBOT = load_robot("rotemina")
TIME_S = np.arange(2000) / 1000.0
SLOW_RING = AxisEffect(
    axis="zn", id=RESONANCE, parameters={"frequency_error": -0.05, "damping_error": 0.0}
)
LATE = AxisEffect(axis="zn", id="delay", parameters={"delay": 2e-4})


def evidence(*effects):
    own = ROBOT.axes["zn"]
    sweep = 0.1 * own.span * np.sin(np.pi * TIME_S * (1.0 + 150.0 * TIME_S))
    commands = Record.from_signals(
        TIME_S, {("zn", Tap.CMD): sum(own.range) / 2 + sweep}, {"zn": own.unit}
    )
    rng = np.random.default_rng(0)
    return Evidence.of(ROBOT, "zn", [simulate(ROBOT, effects, commands, rng) for _ in range(2)])


def test_an_own_parameter_that_alone_closes_its_share_is_a_cause_beside_others():
    seen = evidence(SLOW_RING, LATE)
    found = attributed(seen, untouched(seen), explain(seen, [LATE]))
    assert found.ids == (("delay", None), (RESONANCE, None))


def test_what_was_fitted_without_an_own_parameter_may_take_its_place(monkeypatch):
    seen = evidence(SLOW_RING)
    best = attributed(seen, untouched(seen), explain(seen, []))
    assert best.ids == ((RESONANCE, None),)
    (late,) = without_own(seen, best, [explain(seen, [LATE])], best.ids[0])
    assert RESONANCE not in {one.id for one in late.fit.effects}
    # A fit goes on where another one ended, and may leave more of what it did not see.
    bare = untouched(seen)
    monkeypatch.setattr(attribution, "_without", lambda *_: bare)
    found = attributed(seen, bare, late)
    assert ("delay", None) in found.ids
    assert {name for name, _ in found.ids} <= {"delay", GAIN}
