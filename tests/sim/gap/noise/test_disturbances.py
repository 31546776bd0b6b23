"""Disturbances not caused by commands are found, named and removed; other gaps remain."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.compare import mean_squares
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.noise import (
    Disturbance,
    power_by_tap,
    set_aside,
    wander,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, make_triangles_and_steps

RATE_HZ = 1000.0
TIME_S = np.arange(8000) / RATE_HZ


def remove_disturbances(effects, axis, share=0.1, seeds=(0, 1)):
    command = make_triangles_and_steps(axis, share)
    records = [simulate(ROBOT, effects, command, np.random.default_rng(s)) for s in seeds]
    evidence = Evidence.of(ROBOT, axis, records)
    return evidence, *set_aside(evidence)


def compute_rms(evidence):
    return float(np.sqrt(np.mean(evidence.residual() ** 2)))


def test_a_healthy_axis_has_no_disturbances():
    _, clean, disturbances = remove_disturbances([], "zn")
    assert disturbances == ()
    assert compute_rms(clean) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    "effect",
    [
        AxisEffect(axis="zn", id="sensor_noise"),
        AxisEffect(axis="zn", id="sensor_outliers"),
        AxisEffect(axis="zn", id="sensor_outliers", formulation="dropouts_to_zero"),
        AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": 4e-7}),
        AxisEffect(axis="zn", id="vibration", parameters={"frequency": 37.3, "sine": 2e-7}),
    ],
    ids=lambda effect: f"{effect.id} {effect.formulation or ''}",
)
def test_a_disturbance_is_named_and_removed(effect):
    raw, clean, disturbances = remove_disturbances([effect], "zn")
    assert {
        disturbance.effect
        for disturbance in disturbances
        if disturbance.power > 0.03 * compute_rms(raw) ** 2
    } == {effect.id}
    assert compute_rms(raw) > 1.3
    assert compute_rms(clean) < 1.3


@pytest.mark.parametrize("effect", ["hysteresis", "creep", "resonance_mismatch", "contact"])
def test_gaps_caused_by_commands_are_not_disturbances(effect):
    raw, _, disturbances = remove_disturbances([AxisEffect(axis="zn", id=effect)], "zn")
    power = sum(disturbance.power for disturbance in disturbances)
    assert power < 0.03 * compute_rms(raw) ** 2


def test_lost_steps_are_removed_by_whole_multiples():
    lost_steps = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": -2.0}
    )
    raw, clean, disturbances = remove_disturbances([lost_steps], "x", share=0.01)
    assert {disturbance.effect for disturbance in disturbances} == {"lost_steps"}
    assert compute_rms(raw) > 100.0
    assert compute_rms(clean) < 2.0


def test_lost_steps_are_found_after_the_error_of_a_screw_is_modelled():
    lost_steps = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": 1.0}
    )
    screw = AxisEffect(
        axis="x", id="leadscrew_error", parameters={"period": 1e-3, "sine": 6e-6, "cosine": 1.2e-5}
    )
    raw, _, found_without_screw = remove_disturbances([lost_steps, screw], "x", share=0.05)
    assert found_without_screw == ()
    clean, disturbances = set_aside(raw, [screw])
    assert {disturbance.effect for disturbance in disturbances} == {"lost_steps"}
    assert clean.robot is raw.robot
    # After the jump the screw has another phase, so that some of its error remains.
    before, after = (np.mean(evidence.residual([screw]) ** 2) for evidence in (raw, clean))
    assert after < 0.5 * before


def test_noise_of_a_sensor_is_measured_next_to_its_lag():
    lag = AxisEffect(axis="zn", id="sensor_lag", parameters={"time_constant": 1e-3})
    noise = AxisEffect(axis="zn", id="sensor_noise", parameters={"rms": 3e-8})
    raw, _, _ = remove_disturbances([lag, noise], "zn", share=0.4)
    _, disturbances = set_aside(raw, [lag])
    (sensor_noise,) = [
        disturbance for disturbance in disturbances if disturbance.effect == "sensor_noise"
    ]
    declared_floor = raw.floor(Tap.MEAS)
    assert sensor_noise.power == pytest.approx((3e-8 / declared_floor) ** 2, rel=0.25)


@pytest.mark.parametrize("at_rest", [0.0, 10.0])
def test_noise_of_a_sensor_is_present_at_rest_too(at_rest):
    """A varying delay makes the reading of a moving axis as rough as noise does."""
    time_s = np.arange(6000) / RATE_HZ
    axis = ROBOT.axes["zn"]
    # With short holds.
    motion_time_s = np.minimum(time_s % 0.5, 0.4) + 0.4 * (time_s // 0.5)
    path = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * motion_time_s))
    command = sum(axis.range) / 2 + 0.1 * axis.span * path
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": axis.unit})
    records = []
    for seed in (0, 1):
        rng = np.random.default_rng(seed)
        nominal = simulate(ROBOT, [], commands, rng)
        speed = np.abs(np.gradient(command, time_s))
        noise_rms = axis.sensor.noise_rms * np.maximum(at_rest, 10.0 * speed / speed.max())
        reading = nominal.signal("zn", Tap.MEAS) + noise_rms * rng.standard_normal(len(time_s))
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        records.append(Record.from_signals(time_s, signals, {"zn": axis.unit}))
    _, disturbances = set_aside(Evidence.of(ROBOT, "zn", records))
    assert ("sensor_noise" in [disturbance.effect for disturbance in disturbances]) is bool(at_rest)


def test_a_drift_of_the_sensor_is_distinguished_from_motion():
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 5e-7})
    raw, clean, disturbances = remove_disturbances([drift], "zn")
    assert not {disturbance.effect for disturbance in disturbances} - {"sensor_noise"}
    sensor_wander = wander(clean, clean.residual())
    assert sensor_wander is not None
    meas_power = mean_squares(raw, raw.residual())[Tap.MEAS]
    assert sensor_wander.power == pytest.approx(meas_power, rel=0.2)
    healthy = remove_disturbances([], "zn")[1]
    assert wander(healthy, healthy.residual()) is None


def test_a_vibration_of_the_axis_counts_in_floors_of_its_sensor():
    evidence, _, _ = remove_disturbances([], "zn")
    vibration = Disturbance("vibration", Tap.REF, 100.0, "")
    sensor_noise = Disturbance("sensor_noise", Tap.MEAS, 5.0, "")
    share = (evidence.floor(Tap.REF) / evidence.floor(Tap.MEAS)) ** 2
    power = power_by_tap(evidence, [vibration, sensor_noise])
    assert power == {Tap.REF: 100.0, Tap.MEAS: pytest.approx(5.0 + 100.0 * share)}


def simulate_coarse_reading(*effects):
    coarse = AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": 5e-7})
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.25 * TIME_S))
    command = Record.from_signals(
        TIME_S, {("zn", Tap.CMD): (32.5 + 6.5 * wave) * 1e-6}, {"zn": "m"}
    )
    record = simulate(ROBOT, [coarse, *effects], command, np.random.default_rng(0))
    evidence, disturbances = set_aside(Evidence.of(ROBOT, "zn", [record]))
    assert "sensor_quantization" in {disturbance.effect for disturbance in disturbances}
    assert evidence.observations[0].cell[Tap.MEAS] == pytest.approx(5e-7, rel=0.01)
    return evidence


def test_only_deviations_beyond_the_steps_of_a_coarse_reading_are_a_gap():
    evidence = simulate_coarse_reading()
    assert 0.1 < mean_squares(evidence, evidence.residual())[Tap.MEAS] < 1.3
    gain_error = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.01})
    evidence = simulate_coarse_reading(gain_error)
    # The triangle of 6.5 µm exceeds the edge of a step by up to d = 65 nm, evenly distributed:
    # ∫ d³ / (3 step) up to 1 % of 6.5 µm is d³ / (12 step).
    expected = 6.5e-8**3 / (12.0 * 5e-7)
    power = mean_squares(evidence, evidence.residual())[Tap.MEAS] * evidence.floor(Tap.MEAS) ** 2
    assert power == pytest.approx(expected, rel=0.35)
    assert mean_squares(evidence, evidence.residual([gain_error]))[Tap.MEAS] < 1.3


def test_spikes_at_rest_confirm_those_in_fast_motion():
    rng, rows = np.random.default_rng(0), np.arange(200, 5800, 700)

    def simulate_spikes(path):
        commands = Record.from_signals(TIME_S, {("zn", Tap.CMD): path}, {"zn": "m"})
        record = simulate(ROBOT, [], commands, rng)
        reading = record.signal("zn", Tap.MEAS).copy()
        reading[rows] += 4e-6
        signals = {("zn", Tap.CMD): path, ("zn", Tap.MEAS): reading}
        return Record.from_signals(TIME_S, signals, {"zn": "m"}, dict(record.metadata))

    fast = simulate_spikes((32.5 + 8.0 * np.sign(np.sin(2 * np.pi * 40.0 * TIME_S))) * 1e-6)
    resting = simulate_spikes(np.full(len(TIME_S), 32.5e-6))
    fast_only, _ = set_aside(Evidence.of(ROBOT, "zn", [fast]))
    both, _ = set_aside(Evidence.of(ROBOT, "zn", [fast, resting]))
    assert fast_only.observations[0].kept.get(Tap.MEAS, np.ones(1)).all()
    assert not both.observations[0].kept[Tap.MEAS][rows].any()
