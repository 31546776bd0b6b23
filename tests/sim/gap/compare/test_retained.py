"""A model's own parameters are re-tuned beside a cause only where unseen data ask for it."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.explanations import explain
from rotemina.sim.gap.compare.retained import with_retained
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
BENT = AxisEffect(
    axis="zn",
    id="hysteresis",
    formulation="modified_prandtl_ishlinskii",
    parameters={"width": 8e-6, "shape": 1.3},
)
LOOP_THERE = AxisEffect(
    axis="zn",
    id="hysteresis",
    formulation="prandtl_ishlinskii",
    parameters={"width": 8e-6},
)
LOOP = AxisEffect(axis="zn", id="hysteresis", formulation="prandtl_ishlinskii")


def swings(hertz, rate_hz, seconds):
    """Fading triangles of the z nano axis."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * hertz * time_s))
    command = 32.5e-6 + 25e-6 * wave * np.exp(-time_s / (0.6 * seconds))
    return Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})


def retained(truth, hertz, rate_hz, seconds):
    """The re-tunings that stay beside a loop fitted to records of what is there in truth."""
    rng = np.random.default_rng(4)
    records = [
        simulate(ROBOT, truth, swings(scale * hertz, rate_hz, seconds), rng) for scale in (1.0, 0.7)
    ]
    evidence = Evidence.of(ROBOT, "zn", records)
    best = explain(evidence, [LOOP])
    kept = with_retained(evidence, best, (), Account("zn"), jobs=1)
    assert kept.ids == best.ids
    assert kept.score <= 1.2 * best.score
    return {one.id for one in kept.fit.effects} - {"hysteresis"}


def test_a_retuning_that_only_bends_to_what_a_formula_leaves_is_dropped():
    assert "resonance_mismatch" not in retained([BENT], 0.8, 200.0, 6.0)


@pytest.mark.parametrize("error", [-0.15, 0.1])
def test_a_resonance_that_is_off_and_rings_stays(error):
    off = AxisEffect(axis="zn", id="resonance_mismatch", parameters={"frequency_error": error})
    assert "resonance_mismatch" in retained([BENT, off], 8.0, 4000.0, 1.5)


def test_a_curve_that_nobody_names_corrects_the_model_where_unseen_data_require_it():
    """A small curve next to a loop: too little to be a cause, but the remainder falls."""
    curve = AxisEffect(axis="zn", id="static_nonlinearity", parameters={"s_shape": 0.003})
    assert "static_nonlinearity" in retained([LOOP_THERE, curve], 0.8, 200.0, 6.0)
