"""A wander of the sensor is told from motion."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.location.residual_features import lagged
from rotemina.sim.gap.noise.sensor_wander import wander, wandering
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


RATE_HZ = 1000.0


TIME_S = np.arange(8000) / RATE_HZ


NOISE = np.random.default_rng(0).standard_normal(len(TIME_S))


def steps_and_triangles(axis, share=0.1):
    """Move at constant speed, then in steps with holds between."""
    own = ROBOT.axes[axis]
    wave = 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * 0.5 * TIME_S))
    stairs = np.floor(TIME_S) % 3 - 1.0
    way = np.where(TIME_S < 4.0, wave, 0.3 * stairs)
    return Record.from_signals(
        TIME_S, {(axis, Tap.CMD): sum(own.range) / 2 + share * own.span * way}, {axis: own.unit}
    )


def test_a_record_too_noisy_to_prove_a_wander_counts_once_another_one_does():
    rng = np.random.default_rng(2)
    command = steps_and_triangles("zn")
    drifts = [
        AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": rate}) for rate in (5e-8, 1e-8)
    ]
    records = [simulate(ROBOT, [one], command, rng) for one in drifts]
    evidence = Evidence.of(ROBOT, "zn", records)
    left = evidence.residual()
    loud, quiet = (left[part.rows] for part in evidence.parts if part.tap is Tap.MEAS)
    resting = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, quiet, resting) is None
    told = wander(evidence, left)
    # Of two records alike in length, as far as they are not white.
    beyond = [np.mean(one**2) - np.mean(np.diff(one) ** 2) / 2.0 for one in (loud, quiet)]
    assert beyond[1] > 0.3
    assert told.power == pytest.approx(np.mean(beyond), rel=0.03)


def test_a_wander_must_go_on_at_rest():
    resting = TIME_S > 4.0
    walk = 0.3 * np.cumsum(NOISE)
    told = wandering(TIME_S, walk - walk.mean(), resting)
    assert told.at_rest is True
    assert wandering(TIME_S, _flicker() + NOISE, resting).at_rest is True
    moving = np.where(resting, 0.0, 5.0 * np.sin(2 * np.pi * 0.5 * TIME_S))
    assert wandering(TIME_S, moving, resting).at_rest is False
    relaxing = moving + 40.0 * np.exp(-TIME_S / 3.0)
    assert wandering(TIME_S, relaxing - relaxing.mean(), resting).at_rest is False
    never = np.zeros(len(TIME_S), dtype=bool)
    assert wandering(TIME_S, walk - walk.mean(), never).at_rest is None
    assert wandering(TIME_S, 30.0 * NOISE, resting) is None


def test_a_wander_that_no_rest_can_show_needs_a_reference():
    never = np.zeros(len(TIME_S), dtype=bool)
    walk = 0.3 * np.cumsum(NOISE)
    assert wandering(TIME_S, walk - walk.mean(), never).walks is True
    moving = 20.0 * np.sin(2 * np.pi * 0.5 * TIME_S)
    assert wandering(TIME_S, moving + NOISE, never).walks is False
    drift = AxisEffect(axis="zn", id="sensor_drift", parameters={"rate": 2e-6})
    command = steps_and_triangles("zn")
    moved = Record.from_signals(
        TIME_S[:4000], {("zn", Tap.CMD): command.signal("zn", Tap.CMD)[:4000]}, {"zn": "m"}
    )
    records = [simulate(ROBOT, [drift], moved, np.random.default_rng(seed)) for seed in (0, 1)]
    seen = Evidence.of(ROBOT, "zn", records)
    assert wander(seen, seen.residual()).effect == "sensor_drift"
    blind = [
        Record.from_signals(
            record.time_s,
            {("zn", tap): record.signal("zn", tap) for tap in (Tap.CMD, Tap.MEAS)},
            {"zn": "m"},
        )
        for record in records
    ]
    unseen = Evidence.of(ROBOT, "zn", blind)
    assert wander(unseen, unseen.residual()) is None


def _flicker():
    tones = np.fft.rfft(np.random.default_rng(3).standard_normal(len(TIME_S)))
    tones[1:] /= np.sqrt(np.arange(1, len(tones)))
    tones[0] = 0.0
    flicker = np.fft.irfft(tones, len(TIME_S))
    return 30.0 * flicker / flicker.std()


@pytest.mark.parametrize("again", [False, True])
def test_what_comes_again_in_every_record_is_no_drift_of_the_sensor(again):
    rng = np.random.default_rng(3)
    command = steps_and_triangles("zn")
    records = [simulate(ROBOT, [], command, rng) for _ in range(2)]
    evidence = Evidence.of(ROBOT, "zn", records)
    walks = [0.3 * np.cumsum(np.random.default_rng(seed).standard_normal(8000)) for seed in (1, 2)]
    left = evidence.residual()
    for part in evidence.parts:
        if part.tap is Tap.MEAS:
            left[part.rows] += walks[0 if again else part.record]
    found = wander(evidence, left)
    assert (found is None) is again


def steps_and_holds(seed):
    rng = np.random.default_rng(seed)
    levels = np.repeat(rng.uniform(-0.4, 0.4, 20), 300)
    time_s, own = np.arange(len(levels)) / 200.0, ROBOT.axes["zn"]
    return Record.from_signals(
        time_s, {("zn", Tap.CMD): sum(own.range) / 2 + own.span * levels}, {"zn": own.unit}
    )


def slow_memory(record):
    """Return what a creep of many time constants leaves of an explanation by fewer, in floors."""
    command = record.signal("zn", Tap.CMD)
    activity = (command - command.mean()) / ROBOT.axes["zn"].span
    slow, slower = (lagged(activity, 200.0 * late_s) for late_s in (1.0, 8.0))
    return 15.0 * (slow - slower)


@pytest.mark.parametrize("walking", [0.0, 0.1])
def test_what_the_motion_foretells_is_no_drift_of_the_sensor(walking):
    rng = np.random.default_rng(5)
    records = [simulate(ROBOT, [], steps_and_holds(seed), rng) for seed in (1, 2, 3)]
    evidence = Evidence.of(ROBOT, "zn", records)
    left = evidence.residual()
    for part in evidence.parts:
        if part.tap is Tap.MEAS:
            left[part.rows] += slow_memory(evidence.observations[part.record].record)
            left[part.rows] += walking * np.cumsum(rng.standard_normal(6000))
    assert (wander(evidence, left) is None) is (walking == 0.0)
