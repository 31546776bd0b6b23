"""Screening of a candidate finds minima that a descent would miss."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.compare.explanations import beside
from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.fit import Evidence, fit
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, simulate_sweep


@pytest.mark.parametrize("period", [4e-6, 40e-6])
def test_the_period_of_a_grating_is_found_over_travels_of_any_length(period):
    parameters = {"period": period, "sine": -9e-8, "cosine": 2.3e-7, "second_cosine": -1.8e-7}
    truth = AxisEffect(axis="x", id="encoder_interpolation", parameters=parameters)
    records = [
        simulate_sweep([truth], share=share, seed=seed)
        for seed, share in enumerate((4e-3, 0.08, 2e-3))
    ]
    evidence = Evidence.of(ROBOT, "x", records)
    candidate = AxisEffect(axis="x", id="encoder_interpolation")
    result = screen(evidence, fit(evidence, []), candidate, briefly=True)
    assert result.effect.parameters["period"] == pytest.approx(period, rel=1e-6)
    assert result.cost < 1.5


@pytest.mark.parametrize("centre", [-0.3, 0.17])
def test_a_fit_after_screening_finds_the_centre_of_a_flexure(centre):
    centre_m = centre * ROBOT.axes["zn"].span
    truth = AxisEffect(
        axis="zn",
        id="stiffness_nonlinearity",
        formulation="cubic",
        parameters={"hardening": 0.2, "centre": centre_m},
    )
    records = [simulate_sweep([truth], ("zn",), share=share) for share in (0.45, -0.45)]
    evidence = Evidence.of(ROBOT, "zn", records)
    candidate = AxisEffect(axis="zn", id="stiffness_nonlinearity", formulation="cubic")
    screening = screen(evidence, untouched(evidence).fit, candidate, briefly=True)
    result = fit(evidence, beside(evidence, [screening.effect]))
    assert result.effects[0].parameters["hardening"] == pytest.approx(0.2, rel=0.05)
    assert result.effects[0].parameters["centre"] == pytest.approx(centre_m, rel=0.05)


def test_a_delay_of_several_periods_is_found_among_local_minima():
    truth = AxisEffect(axis="zn", id="delay", parameters={"delay": 5.07e-3})
    time_s = np.arange(2400) / 4000.0
    axis = ROBOT.axes["zn"]
    steps = axis.range[0] + axis.span * np.where(time_s % 0.2 < 0.1, 0.3, 0.6)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    evidence = Evidence.of(
        ROBOT, "zn", [simulate(ROBOT, [truth], commands, np.random.default_rng(0))]
    )
    candidate = AxisEffect(axis="zn", id="delay")
    result = screen(evidence, fit(evidence, []), candidate, briefly=True)
    assert result.effect.parameters["delay"] == pytest.approx(5.07e-3, abs=1e-4)
    assert fit(evidence, [result.effect]).cost < 1.2
