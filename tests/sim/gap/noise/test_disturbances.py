"""What commands do not cause is found, named and set aside; what they do cause is left alone."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.explanations import mean_squares
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.noise.disturbances import Disturbance, power_by_tap, set_aside
from rotemina.sim.gap.noise.sensor_wander import wander
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


RATE_HZ = 1000.0


TIME_S = np.arange(8000) / RATE_HZ


def steps_and_triangles(axis, share=0.1):
    """Move at constant speed, then in steps with holds between."""
    own = ROBOT.axes[axis]
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.5 * TIME_S))
    stairs = np.floor(TIME_S) % 3 - 1.0
    way = np.where(TIME_S < 4.0, wave, 0.3 * stairs)
    return Record.from_signals(
        TIME_S, {(axis, Tap.CMD): sum(own.range) / 2 + share * own.span * way}, {axis: own.unit}
    )


def aside(effects, axis, share=0.1, seeds=(0, 1)):
    command = steps_and_triangles(axis, share)
    records = [simulate(ROBOT, effects, command, np.random.default_rng(s)) for s in seeds]
    evidence = Evidence.of(ROBOT, axis, records)
    return evidence, *set_aside(evidence)


def rms(evidence):
    return float(np.sqrt(np.mean(evidence.residual() ** 2)))


@pytest.mark.parametrize("axis", ["zn", "thx"])
def test_a_healthy_axis_has_no_disturbances(axis):
    _, clean, found = aside([], axis)
    assert found == ()
    assert rms(clean) == pytest.approx(1.0, abs=0.05)


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
def test_a_disturbance_is_named_and_set_aside(effect):
    raw, clean, found = aside([effect], "zn")
    assert {one.effect for one in found if one.power > 0.03 * rms(raw) ** 2} == {effect.id}
    assert rms(raw) > 1.3
    assert rms(clean) < 1.3


@pytest.mark.parametrize(
    "effect", ["hysteresis", "delay", "creep", "gain_error", "resonance_mismatch", "contact"]
)
def test_what_commands_cause_is_no_disturbance(effect):
    raw, _, found = aside([AxisEffect(axis="zn", id=effect)], "zn")
    power = sum(one.power for one in found)
    assert power < 0.03 * rms(raw) ** 2


def test_lost_steps_are_taken_back_by_whole_multiples():
    lost = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": -2.0}
    )
    raw, clean, found = aside([lost], "x", share=0.01)
    assert {one.effect for one in found} == {"lost_steps"}
    assert rms(raw) > 100.0
    assert rms(clean) < 2.0


def test_lost_steps_that_a_screw_hides_are_seen_beside_its_error():
    lost = AxisEffect(
        axis="x", id="lost_steps", formulation="event", parameters={"time": 2.3, "slips": 1.0}
    )
    screw = AxisEffect(
        axis="x", id="leadscrew_error", parameters={"period": 1e-3, "sine": 6e-6, "cosine": 1.2e-5}
    )
    raw, _, hidden = aside([lost, screw], "x", share=0.05)
    assert hidden == ()
    clean, found = set_aside(raw, [screw])
    assert {one.effect for one in found} == {"lost_steps"}
    assert clean.robot is raw.robot
    # Behind the jump the screw stands elsewhere: some of its error is left.
    before, after = (np.mean(one.residual([screw]) ** 2) for one in (raw, clean))
    assert after < 0.5 * before


def test_noise_behind_a_late_sensor_is_measured_beside_its_lag():
    lag = AxisEffect(axis="zn", id="sensor_lag", parameters={"time_constant": 1e-3})
    noise = AxisEffect(axis="zn", id="sensor_noise", parameters={"rms": 3e-8})
    raw, _, _ = aside([lag, noise], "zn", share=0.4)
    _, found = set_aside(raw, [lag])
    (one,) = [each for each in found if each.effect == "sensor_noise"]
    declared = raw.floor(Tap.MEAS)
    assert one.power == pytest.approx((3e-8 / declared) ** 2, rel=0.25)


@pytest.mark.parametrize("at_rest", [0.0, 10.0])
def test_noise_of_a_sensor_is_there_at_rest_as_well(at_rest):
    """A delay that is never quite the same makes a moving axis' reading as rough as noise does."""
    time_s = np.arange(6000) / RATE_HZ
    own = ROBOT.axes["zn"]
    moving = np.minimum(time_s % 0.5, 0.4) + 0.4 * (time_s // 0.5)  # with short holds
    way = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * moving))
    command = sum(own.range) / 2 + 0.1 * own.span * way
    moved = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": own.unit})
    records = []
    for seed in (0, 1):
        rng = np.random.default_rng(seed)
        nominal = simulate(ROBOT, [], moved, rng)
        pace = np.abs(np.gradient(command, time_s))
        size = own.sensor.noise_rms * np.maximum(at_rest, 10.0 * pace / pace.max())
        reading = nominal.signal("zn", Tap.MEAS) + size * rng.standard_normal(len(time_s))
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): reading}
        records.append(Record.from_signals(time_s, signals, {"zn": own.unit}))
    _, found = set_aside(Evidence.of(ROBOT, "zn", records))
    assert ("sensor_noise" in [one.effect for one in found]) is bool(at_rest)


def test_a_wander_of_the_sensor_is_told_from_motion():
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 5e-7})
    raw, clean, found = aside([drift], "zn")
    assert not {one.effect for one in found} - {"sensor_noise"}
    told = wander(clean, clean.residual())
    assert told is not None
    reading = mean_squares(raw, raw.residual())[Tap.MEAS]
    assert told.power == pytest.approx(reading, rel=0.2)
    assert wander(*(lambda e: (e, e.residual()))(aside([], "zn")[1])) is None


def test_what_shakes_the_axis_counts_at_its_sensor_in_floors_of_the_sensor():
    seen, _, _ = aside([], "zn")
    shaken = Disturbance("vibration", Tap.REF, 100.0, "")
    noisy = Disturbance("sensor_noise", Tap.MEAS, 5.0, "")
    share = (seen.floor(Tap.REF) / seen.floor(Tap.MEAS)) ** 2
    found = power_by_tap(seen, [shaken, noisy])
    assert found == {Tap.REF: 100.0, Tap.MEAS: pytest.approx(5.0 + 100.0 * share)}


def _read_in_steps(*effects):
    coarse = AxisEffect(axis="zn", id="sensor_quantization", parameters={"step": 5e-7})
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.25 * TIME_S))
    command = Record.from_signals(
        TIME_S, {("zn", Tap.CMD): (32.5 + 6.5 * wave) * 1e-6}, {"zn": "m"}
    )
    record = simulate(ROBOT, [coarse, *effects], command, np.random.default_rng(0))
    seen, found = set_aside(Evidence.of(ROBOT, "zn", [record]))
    assert "sensor_quantization" in {one.effect for one in found}
    assert seen.observations[0].cell[Tap.MEAS] == pytest.approx(5e-7, rel=0.01)
    return seen


def test_what_lies_within_the_steps_of_a_coarse_reading_is_no_gap():
    even = _read_in_steps()
    assert 0.1 < mean_squares(even, even.residual())[Tap.MEAS] < 1.3


def test_what_lies_beyond_the_steps_of_a_coarse_reading_is_a_gap():
    bent = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.01})
    seen = _read_in_steps(bent)
    # The triangle of 6.5 µm reaches 65 nm beyond an edge, in that share of the rows of a step:
    # ∫ d³ / (3 step) over its even spread, to 1 % of 6.5 µm, is d³ / (12 step).
    expected = 6.5e-8**3 / (12.0 * 5e-7)
    left = mean_squares(seen, seen.residual())[Tap.MEAS] * seen.floor(Tap.MEAS) ** 2
    assert left == pytest.approx(expected, rel=0.35)
    assert mean_squares(seen, seen.residual([bent]))[Tap.MEAS] < 1.3


def test_spikes_at_rest_prove_those_in_lively_motion():
    lively = Record.from_signals(
        TIME_S,
        {("zn", Tap.CMD): (32.5 + 8.0 * np.sign(np.sin(2 * np.pi * 40.0 * TIME_S))) * 1e-6},
        {"zn": "m"},
    )
    held = np.full(len(TIME_S), 32.5e-6)
    calm = Record.from_signals(TIME_S, {("zn", Tap.CMD): held}, {"zn": "m"})
    rng = np.random.default_rng(0)

    def spiked(record, rows):
        seen = simulate(ROBOT, [], record, rng)
        reading = seen.signal("zn", Tap.MEAS).copy()
        reading[rows] += 4e-6
        signals = {("zn", Tap.CMD): seen.signal("zn", Tap.CMD), ("zn", Tap.MEAS): reading}
        return Record.from_signals(seen.time_s, signals, {"zn": "m"}, dict(seen.metadata))

    rows = np.arange(200, 5800, 700)
    alone, _ = set_aside(Evidence.of(ROBOT, "zn", [spiked(lively, rows)]))
    both, _ = set_aside(Evidence.of(ROBOT, "zn", [spiked(lively, rows), spiked(calm, rows)]))
    assert Tap.MEAS not in alone.observations[0].kept or alone.observations[0].kept[Tap.MEAS].all()
    assert not both.observations[0].kept[Tap.MEAS][rows].any()
