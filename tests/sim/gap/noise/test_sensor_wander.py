"""Drift of a sensor is distinguished from motion."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.location import apply_lag
from rotemina.sim.gap.noise import wander
from rotemina.sim.gap.noise.sensor_wander import wandering
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, make_triangles_and_steps

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ
NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def test_a_record_too_noisy_to_prove_a_drift_counts_if_another_one_proves_it():
    rng = np.random.default_rng(2)
    command = make_triangles_and_steps("zn")
    drifts = [
        AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": rate}) for rate in (5e-8, 1e-8)
    ]
    records = [simulate(ROBOT, [drift], command, rng) for drift in drifts]
    evidence = Evidence.of(ROBOT, "zn", records)
    residual = evidence.residual()
    strong, weak = (residual[part.rows] for part in evidence.parts if part.tap is Tap.MEAS)
    resting = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, weak, resting) is None
    sensor_wander = wander(evidence, residual)
    # The power of two equally long records without their white noise.
    excess_power = [
        np.mean(signal**2) - np.mean(np.diff(signal) ** 2) / 2.0 for signal in (strong, weak)
    ]
    assert excess_power[1] > 0.3
    assert sensor_wander.power == pytest.approx(np.mean(excess_power), rel=0.03)


def test_a_drift_must_continue_at_rest():
    resting = TIME_S > 4.0
    walk = 0.3 * np.cumsum(NOISE)
    sensor_wander = wandering(TIME_S, walk - walk.mean(), resting)
    assert sensor_wander.at_rest is True
    assert wandering(TIME_S, _make_flicker_noise() + NOISE, resting).at_rest is True
    moving = np.where(resting, 0.0, 5.0 * np.sin(2 * np.pi * 0.5 * TIME_S))
    assert wandering(TIME_S, moving, resting).at_rest is False
    relaxing = moving + 40.0 * np.exp(-TIME_S / 3.0)
    assert wandering(TIME_S, relaxing - relaxing.mean(), resting).at_rest is False
    never_resting = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, walk - walk.mean(), never_resting).at_rest is None
    assert wandering(TIME_S, 30.0 * NOISE, resting) is None


def test_a_drift_without_rests_needs_a_reference():
    never_resting = np.zeros(len(TIME_S), dtype=bool)
    walk = 0.3 * np.cumsum(NOISE)
    assert wandering(TIME_S, walk - walk.mean(), never_resting).walks is True
    moving = 20.0 * np.sin(2 * np.pi * 0.5 * TIME_S)
    assert wandering(TIME_S, moving + NOISE, never_resting).walks is False
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 2e-6})
    command = make_triangles_and_steps("zn")
    short_commands = Record.from_signals(
        TIME_S[:4000], {("zn", Tap.CMD): command.signal("zn", Tap.CMD)[:4000]}, {"zn": "m"}
    )
    records = [
        simulate(ROBOT, [drift], short_commands, np.random.default_rng(seed)) for seed in (0, 1)
    ]
    evidence = Evidence.of(ROBOT, "zn", records)
    assert wander(evidence, evidence.residual()).effect == "sensor_drift"
    records_without_reference = [
        Record.from_signals(
            record.time_s,
            {("zn", tap): record.signal("zn", tap) for tap in (Tap.CMD, Tap.MEAS)},
            {"zn": "m"},
        )
        for record in records
    ]
    evidence_without_reference = Evidence.of(ROBOT, "zn", records_without_reference)
    assert wander(evidence_without_reference, evidence_without_reference.residual()) is None


def _make_flicker_noise():
    spectrum = np.fft.rfft(np.random.default_rng(3).standard_normal(len(TIME_S)))
    spectrum[1:] /= np.sqrt(np.arange(1, len(spectrum)))
    spectrum[0] = 0.0
    flicker = np.fft.irfft(spectrum, len(TIME_S))
    return 30.0 * flicker / flicker.std()


@pytest.mark.parametrize("is_repeated", [False, True])
def test_a_deviation_repeated_in_every_record_is_not_a_drift_of_the_sensor(is_repeated):
    rng = np.random.default_rng(3)
    command = make_triangles_and_steps("zn")
    records = [simulate(ROBOT, [], command, rng) for _ in range(2)]
    evidence = Evidence.of(ROBOT, "zn", records)
    walks = [0.3 * np.cumsum(np.random.default_rng(seed).standard_normal(8000)) for seed in (1, 2)]
    residual = evidence.residual()
    for part in evidence.parts:
        if part.tap is Tap.MEAS:
            residual[part.rows] += walks[0 if is_repeated else part.record]
    sensor_wander = wander(evidence, residual)
    assert (sensor_wander is None) is is_repeated


def make_steps_and_holds(seed):
    rng = np.random.default_rng(seed)
    levels = np.repeat(rng.uniform(-0.4, 0.4, 20), 300)
    time_s, axis = np.arange(len(levels)) / 200.0, ROBOT.axes["zn"]
    return Record.from_signals(
        time_s, {("zn", Tap.CMD): sum(axis.range) / 2 + axis.span * levels}, {"zn": axis.unit}
    )


def make_slow_memory(record):
    """Return the remainder, in floors, of creep fitted with too few time constants."""
    command = record.signal("zn", Tap.CMD)
    activity = (command - command.mean()) / ROBOT.axes["zn"].span
    slow, slower = (apply_lag(activity, 200.0 * lag_s) for lag_s in (1.0, 8.0))
    return 15.0 * (slow - slower)


@pytest.mark.parametrize("walk_size", [0.0, 0.1])
def test_a_deviation_that_the_motion_predicts_is_not_a_drift_of_the_sensor(walk_size):
    rng = np.random.default_rng(5)
    records = [simulate(ROBOT, [], make_steps_and_holds(seed), rng) for seed in (1, 2, 3)]
    evidence = Evidence.of(ROBOT, "zn", records)
    residual = evidence.residual()
    for part in evidence.parts:
        if part.tap is Tap.MEAS:
            residual[part.rows] += make_slow_memory(evidence.observations[part.record].record)
            residual[part.rows] += walk_size * np.cumsum(rng.standard_normal(6000))
    assert (wander(evidence, residual) is None) is (walk_size == 0.0)
