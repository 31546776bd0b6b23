"""The grid of a coarse converter, found although the mechanics oscillate after every step."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.fit import Evidence, starts
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, simulate_chirps


def find_grids(axis, records):
    evidence = Evidence.of(ROBOT, axis, records)
    candidate = AxisEffect(axis=axis, id="quantization")
    return [start.parameters for start in starts(evidence, untouched(evidence).fit, candidate)]


@pytest.mark.parametrize(
    ("axis", "volts", "shares"),
    [("thx", 0.25, (0.2, 0.11)), ("zn", 0.4, (0.3,))],
)
def test_width_and_shift_of_steps_are_found(axis, volts, shares):
    steps = AxisEffect(axis=axis, id="quantization", parameters={"step": volts, "shift": 0.2})
    records = simulate_chirps(axis, [steps], *shares)
    evidence = Evidence.of(ROBOT, axis, records)
    (_, parameters) = find_grids(axis, records)
    attached = AttachedEffect.of(ROBOT, steps)
    step_count = max(shares) * attached.facts.input_span / volts
    assert parameters["step"] == pytest.approx(volts, rel=0.01 / step_count)
    assert parameters["shift"] == pytest.approx(0.2, abs=0.05)
    cost_before = float(np.mean(evidence.residual() ** 2))
    found_effect = AxisEffect(axis=axis, id="quantization", parameters=parameters)
    assert np.mean(evidence.residual([found_effect]) ** 2) - 1.0 < 0.05 * (cost_before - 1.0)


@pytest.mark.parametrize("are_omitted", [True, False])
def test_steps_are_found_despite_spikes_of_a_sensor(are_omitted):
    steps = AxisEffect(axis="y", id="quantization", parameters={"step": 7e-6, "shift": 0.2})
    records = simulate_chirps("y", [steps], 0.002, 0.05)
    evidence, rng = Evidence.of(ROBOT, "y", records), np.random.default_rng(1)
    observations = []
    for observation in evidence.observations:
        is_spike = rng.uniform(size=len(observation.record.time_s)) < 0.003
        reading = observation.real[Tap.MEAS] + 2e-5 * is_spike
        kept = {Tap.MEAS: ~is_spike} if are_omitted else {}
        observations.append(
            replace(observation, real={**observation.real, Tap.MEAS: reading}, kept=kept)
        )
    evidence = evidence.with_observations(observations)
    candidate = AxisEffect(axis="y", id="quantization")
    (_, parameters) = [
        start.parameters for start in starts(evidence, untouched(evidence).fit, candidate)
    ]
    assert parameters["step"] == pytest.approx(7e-6, rel=0.1 * 7e-6 / (0.05 * ROBOT.axes["y"].span))
    assert parameters["shift"] == pytest.approx(0.2, abs=0.05)


def test_a_healthy_axis_shows_no_steps():
    assert len(find_grids("thx", simulate_chirps("thx", [], 0.2, 0.1))) == 1
