"""The grid of a coarse converter, found through mechanics that ring with every step."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.compare.explanations import untouched
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.fit_starts import starts
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def recorded(axis, effects, *shares, rate_hz=1000.0, seed=0):
    """Sweeps of growing pace over shares of the range, one record each."""
    own, rng = ROBOT.axes[axis], np.random.default_rng(seed)
    records = []
    for share in shares:
        time_s = np.arange(6000) / rate_hz
        wave = np.sin(2.0 * np.pi * (0.1 * time_s + 0.05 * time_s**2))
        command = sum(own.range) / 2 + share * own.span * wave
        record = Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: own.unit})
        records.append(simulate(ROBOT, effects, record, rng))
    return records


def grids(axis, records):
    evidence = Evidence.of(ROBOT, axis, records)
    asked = AxisEffect(axis=axis, id="quantization")
    return [one.parameters for one in starts(evidence, untouched(evidence).fit, asked)]


@pytest.mark.parametrize(
    ("axis", "volts", "shares"),
    [("thx", 0.6, (0.15, 0.28)), ("thx", 0.25, (0.2, 0.11)), ("zn", 0.4, (0.3,))],
)
def test_width_and_shift_of_steps_are_found(axis, volts, shares):
    steps = AxisEffect(axis=axis, id="quantization", parameters={"step": volts, "shift": 0.2})
    records = recorded(axis, [steps], *shares)
    evidence = Evidence.of(ROBOT, axis, records)
    (_, found) = grids(axis, records)
    attached = Attached.of(ROBOT, steps)
    steps_of_way = max(shares) * attached.facts.input_span / volts
    assert found["step"] == pytest.approx(volts, rel=0.01 / steps_of_way)
    assert found["shift"] == pytest.approx(0.2, abs=0.05)
    before = float(np.mean(evidence.residual() ** 2))
    named = AxisEffect(axis=axis, id="quantization", parameters=found)
    assert np.mean(evidence.residual([named]) ** 2) - 1.0 < 0.05 * (before - 1.0)


@pytest.mark.parametrize("left_out", [True, False])
def test_steps_are_found_among_the_spikes_of_a_sensor(left_out):
    steps = AxisEffect(axis="y", id="quantization", parameters={"step": 7e-6, "shift": 0.2})
    records = recorded("y", [steps], 0.002, 0.05)
    evidence, rng = Evidence.of(ROBOT, "y", records), np.random.default_rng(1)
    observations = []
    for one in evidence.observations:
        spiked = rng.uniform(size=len(one.record.time_s)) < 0.003
        reading = one.real[Tap.MEAS] + 2e-5 * spiked
        kept = {Tap.MEAS: ~spiked} if left_out else {}
        observations.append(replace(one, real={**one.real, Tap.MEAS: reading}, kept=kept))
    evidence = evidence.with_observations(observations)
    asked = AxisEffect(axis="y", id="quantization")
    (_, found) = [one.parameters for one in starts(evidence, untouched(evidence).fit, asked)]
    assert found["step"] == pytest.approx(7e-6, rel=0.1 * 7e-6 / (0.05 * ROBOT.axes["y"].span))
    assert found["shift"] == pytest.approx(0.2, abs=0.05)


def test_a_healthy_axis_shows_no_steps():
    assert len(grids("thx", recorded("thx", [], 0.2, 0.1))) == 1
