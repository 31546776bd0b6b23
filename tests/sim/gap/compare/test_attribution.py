"""Parameters of the model as causes, compared with rivals that are fitted without them."""

import numpy as np

from rotemina.sim.gap.compare import attribution, explain, untouched
from rotemina.sim.gap.compare.attribution import attributed, without_own
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

GAIN, RESONANCE = "gain_error", "resonance_mismatch"
ROBOT = load_robot("rotemina")
TIME_S = np.arange(2000) / 1000.0
RESONANCE_SHIFT = AxisEffect(
    axis="zn", id=RESONANCE, parameters={"frequency_error": -0.05, "damping_error": 0.0}
)
DELAY = AxisEffect(axis="zn", id="delay", parameters={"delay": 2e-4})


def make_evidence(*effects):
    axis = ROBOT.axes["zn"]
    sweep = 0.1 * axis.span * np.sin(np.pi * TIME_S * (1.0 + 150.0 * TIME_S))
    commands = Record.from_signals(
        TIME_S, {("zn", Tap.CMD): sum(axis.range) / 2 + sweep}, {"zn": axis.unit}
    )
    rng = np.random.default_rng(0)
    return Evidence.of(ROBOT, "zn", [simulate(ROBOT, effects, commands, rng) for _ in range(2)])


def test_a_model_parameter_that_alone_closes_its_share_is_a_cause_among_others():
    evidence = make_evidence(RESONANCE_SHIFT, DELAY)
    explanation = attributed(evidence, untouched(evidence), explain(evidence, [DELAY]))
    assert explanation.ids == (("delay", None), (RESONANCE, None))


def test_a_cause_fitted_without_a_model_parameter_may_replace_it(monkeypatch):
    evidence = make_evidence(RESONANCE_SHIFT)
    best = attributed(evidence, untouched(evidence), explain(evidence, []))
    assert best.ids == ((RESONANCE, None),)
    (with_delay,) = without_own(evidence, best, [explain(evidence, [DELAY])], best.ids[0])
    assert RESONANCE not in {effect.id for effect in with_delay.fit.effects}
    # A fit continues from another one, and may leave a larger gap in unseen data.
    untouched_model = untouched(evidence)
    monkeypatch.setattr(attribution, "_without", lambda *_: untouched_model)
    explanation = attributed(evidence, untouched_model, with_delay)
    assert ("delay", None) in explanation.ids
    assert {name for name, _ in explanation.ids} <= {"delay", GAIN}
