"""Parameters of the model are re-tuned together with a cause only if unseen data require it."""

import numpy as np

from rotemina.sim.gap.compare import explain, with_retained
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.result import Account
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
MODIFIED_HYSTERESIS = AxisEffect(
    axis="zn",
    id="hysteresis",
    formulation="modified_prandtl_ishlinskii",
    parameters={"width": 8e-6, "shape": 1.3},
)
TRUE_HYSTERESIS = AxisEffect(
    axis="zn",
    id="hysteresis",
    formulation="prandtl_ishlinskii",
    parameters={"width": 8e-6},
)
HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", formulation="prandtl_ishlinskii")


def make_commands(hertz, rate_hz, seconds):
    """Return decaying triangles of the z nano axis."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * hertz * time_s))
    command = 32.5e-6 + 25e-6 * wave * np.exp(-time_s / (0.6 * seconds))
    return Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})


def find_retained(truth, hertz, rate_hz, seconds):
    """Return the re-tuned parameters that remain next to fitted hysteresis, for true effects."""
    rng = np.random.default_rng(4)
    records = [
        simulate(ROBOT, truth, make_commands(scale * hertz, rate_hz, seconds), rng)
        for scale in (1.0, 0.7)
    ]
    evidence = Evidence.of(ROBOT, "zn", records)
    best = explain(evidence, [HYSTERESIS])
    explanation = with_retained(evidence, best, (), Account("zn"), jobs=1)
    assert explanation.ids == best.ids
    assert explanation.score <= 1.2 * best.score
    return {effect.id for effect in explanation.fit.effects} - {"hysteresis"}


def test_a_retuning_that_only_fits_an_error_of_a_formula_is_dropped():
    assert "resonance_mismatch" not in find_retained([MODIFIED_HYSTERESIS], 0.8, 200.0, 6.0)


def test_a_wrong_resonance_that_oscillates_is_retained():
    mismatch = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": 0.1})
    assert "resonance_mismatch" in find_retained([MODIFIED_HYSTERESIS, mismatch], 8.0, 4000.0, 1.5)


def test_an_unnamed_curve_corrects_the_model_if_unseen_data_require_it():
    """A small curve next to hysteresis is too small to be a cause, but reduces the remainder."""
    curve = AxisEffect(axis="zn", id="static_nonlinearity", parameters={"s_shape": 0.003})
    assert "static_nonlinearity" in find_retained([TRUE_HYSTERESIS, curve], 0.8, 200.0, 6.0)
