"""Records of unknown history: their offset and memory are not a gap."""

from dataclasses import replace

import numpy as np

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("picma")
HYSTERESIS = AxisEffect(axis="p", id="hysteresis", parameters={"width": 5e-6, "shape": 1.0})
CREEP = AxisEffect(axis="p", id="creep", parameters={"rate": 0.02, "onset": 0.1})
RATE_HZ = 200.0
NOISE_M = 2e-8


def make_record(effects, before, history):
    """Return a record of small oscillations without the motion ``before`` (n,) that preceded it."""
    time_s = np.arange(1200) / RATE_HZ
    visible = 2e-5 + 4e-6 * np.sin(2.0 * np.pi * time_s)
    path = np.concatenate([before, visible])
    plant = Plant.of(replace(ROBOT, effects=tuple(effects)))
    motion, _ = plant.advance(
        plant.find_rest_state(0.0, path[:1]), np.arange(len(path)) / RATE_HZ, path[:, None]
    )
    reading = motion.position[len(before) :, 0] + 3e-5
    reading = reading + NOISE_M * np.random.default_rng(0).standard_normal(1200)
    signals = {("p", Tap.CMD): visible, ("p", Tap.MEAS): reading}
    return Record.from_signals(time_s, signals, {"p": "m"}, {"history": history})


def compute_residual_rms(effects, record):
    evidence = Evidence.of(ROBOT, "p", [record])
    return float(np.sqrt(np.mean(evidence.residual(effects) ** 2)))


FROM_HIGH_END = np.concatenate([np.linspace(0.0, 4.6e-5, 400), np.full(2000, 4.6e-5)])


def test_the_previous_motion_is_not_a_gap_if_the_history_is_unknown():
    effects = (HYSTERESIS, CREEP)
    assert compute_residual_rms(effects, make_record(effects, FROM_HIGH_END, "unknown")) < 1.5
    assert compute_residual_rms(effects, make_record(effects, FROM_HIGH_END, "known")) > 3.0


def test_a_model_without_the_effect_still_has_a_gap():
    assert compute_residual_rms((), make_record((HYSTERESIS,), FROM_HIGH_END, "unknown")) > 5.0


def test_memory_does_not_explain_another_effect():
    """A slightly wrong clock depends little on its start, which therefore cannot explain a lag."""
    delay = AxisEffect(axis="p", id="delay", parameters={"delay": 0.02})
    clock_skew = AxisEffect(axis="p", id="clock_skew", parameters={"skew": 40.0})
    record = make_record((delay,), FROM_HIGH_END, "unknown")
    assert compute_residual_rms((clock_skew,), record) > 0.9 * compute_residual_rms((), record)


PIEZO_ROBOT = load_robot("rotemina")
WIDE_HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 1e-5, "shape": 1.0})


DESCENT = np.linspace(PIEZO_ROBOT.axes["zn"].range[1], 3e-5, 2000)
RECORDED = 3e-5 + 8e-6 * np.sin(2.0 * np.pi * 1.5 * np.arange(2000) / 1000.0)


def simulate_continued_record(previous=DESCENT):
    """Return small oscillations of a resonant axis after a slow previous motion (2000,), SI."""
    path = np.concatenate([previous, np.full(1000, 3e-5), RECORDED])
    commands = Record.from_signals(np.arange(5000) / 1000.0, {("zn", Tap.CMD): path}, {"zn": "m"})
    full_record = simulate(PIEZO_ROBOT, [WIDE_HYSTERESIS], commands, np.random.default_rng(2))
    signals = {("zn", tap): full_record.signal("zn", tap)[3000:] for tap in (Tap.CMD, Tap.MEAS)}
    return Record.from_signals(
        full_record.time_s[3000:], signals, {"zn": "m"}, {"history": "unknown"}
    )


def test_an_axis_that_came_from_the_high_end_has_no_gap():
    evidence = Evidence.of(PIEZO_ROBOT, "zn", [simulate_continued_record()])
    floors = np.abs(evidence.residual((WIDE_HYSTERESIS,)))
    # This includes the first row.
    assert floors.max() < 6.0
    assert floors.mean() < 0.9


def test_an_axis_that_made_the_same_motion_before_has_almost_no_gap():
    """In a repeated experiment the unknown memory must not suggest another cause."""
    residual = Evidence.of(PIEZO_ROBOT, "zn", [simulate_continued_record(RECORDED)]).residual(
        (WIDE_HYSTERESIS,)
    )
    assert np.mean(residual**2) < 2.0


def test_responses_with_memory_fit_a_record_best():
    evidence = Evidence.of(PIEZO_ROBOT, "zn", [simulate_continued_record()])
    real = evidence.observations[0].real[Tap.MEAS]
    (plain,), (with_memory,) = (
        compute((WIDE_HYSTERESIS,)) for compute in (evidence.response, evidence.remembering)
    )
    plain_error, memory_error = (
        np.std(real - response[Tap.MEAS]) for response in (plain, with_memory)
    )
    assert memory_error < 0.05 * plain_error


def test_other_starts_are_simulated_only_while_they_matter(monkeypatch):
    lag = AxisEffect(axis="zn", id="amplifier_lag", parameters={"time_constant": 2e-3})
    evidence = Evidence.of(PIEZO_ROBOT, "zn", [simulate_continued_record()])
    rows = []
    advance = Plant.advance

    def count_rows(plant, state, time_s, *args, **options):
        rows.append(len(time_s))
        return advance(plant, state, time_s, *args, **options)

    monkeypatch.setattr(Plant, "advance", count_rows)
    residual = evidence.residual((lag,))
    simulated_rows = sum(rows)
    rows.clear()
    monkeypatch.setattr("rotemina.sim.gap.fit.evidence._FORGETS", 1)
    full_residual = evidence.residual((lag,))
    assert simulated_rows < 0.6 * sum(rows)
    assert np.abs(residual - full_residual).max() < 0.1
