"""A look at a candidate finds what a fit cannot find downhill."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import beside, untouched
from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from sweeps import ROBOT, sweep


@pytest.mark.parametrize("period", [4e-6, 10e-6, 40e-6])
def test_the_period_of_a_grating_is_found_over_ways_of_any_length(period):
    numbers = {"period": period, "sine": -9e-8, "cosine": 2.3e-7, "second_cosine": -1.8e-7}
    truth = AxisEffect(axis="x", id="encoder_interpolation", parameters=numbers)
    ways = [sweep([truth], share=share, seed=seed) for seed, share in enumerate((4e-3, 0.08, 2e-3))]
    evidence = Evidence.of(ROBOT, "x", ways)
    bare = AxisEffect(axis="x", id="encoder_interpolation")
    found = screen(evidence, fit(evidence, []), bare, briefly=True)
    assert found.effect.parameters["period"] == pytest.approx(period, rel=1e-6)
    assert found.cost < 1.5


@pytest.mark.parametrize("centre", [-0.3, 0.17, 0.4])
def test_a_fit_from_a_first_look_finds_a_flexure_wherever_it_is_straight(centre):
    centre_m = centre * ROBOT.axes["zn"].span
    truth = AxisEffect(
        axis="zn",
        id="stiffness_nonlinearity",
        formulation="cubic",
        parameters={"hardening": 0.2, "centre": centre_m},
    )
    seen = [sweep([truth], ("zn",), share=share) for share in (0.45, -0.45)]
    evidence = Evidence.of(ROBOT, "zn", seen)
    bare = AxisEffect(axis="zn", id="stiffness_nonlinearity", formulation="cubic")
    look = screen(evidence, untouched(evidence).fit, bare, briefly=True)
    found = fit(evidence, beside(evidence, [look.effect]))
    assert found.effects[0].parameters["hardening"] == pytest.approx(0.2, rel=0.05)
    assert found.effects[0].parameters["centre"] == pytest.approx(centre_m, rel=0.05)


def test_a_delay_of_some_rings_is_found_among_the_minima_between_them():
    truth = AxisEffect(axis="zn", id="delay", parameters={"delay": 5.07e-3})
    time_s = np.arange(2400) / 4000.0
    own = ROBOT.axes["zn"]
    steps = own.range[0] + own.span * np.where(time_s % 0.2 < 0.1, 0.3, 0.6)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    evidence = Evidence.of(
        ROBOT, "zn", [simulate(ROBOT, [truth], commands, np.random.default_rng(0))]
    )
    bare = AxisEffect(axis="zn", id="delay")
    found = screen(evidence, fit(evidence, []), bare, briefly=True)
    assert found.effect.parameters["delay"] == pytest.approx(5.07e-3, abs=1e-4)
    assert fit(evidence, [found.effect]).cost < 1.2
