"""Records of unknown history: offset and memory are their own, and no gap."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("picma")
LOOP = AxisEffect(axis="p", id="hysteresis", parameters={"width": 5e-6, "shape": 1.0})
CREEP = AxisEffect(axis="p", id="creep", parameters={"rate": 0.02, "onset": 0.1})
RATE_HZ = 200.0
NOISE_M = 2e-8


def recorded(effects, before, history):
    """A record of small swings, of which only the last part is given: ``before`` (n,) is not."""
    time_s = np.arange(1200) / RATE_HZ
    shown = 2e-5 + 4e-6 * np.sin(2.0 * np.pi * time_s)
    path = np.concatenate([before, shown])
    plant = Plant.of(replace(ROBOT, effects=tuple(effects)))
    motion, _ = plant.advance(
        plant.at_rest(0.0, path[:1]), np.arange(len(path)) / RATE_HZ, path[:, None]
    )
    reading = motion.position[len(before) :, 0] + 3e-5
    reading = reading + NOISE_M * np.random.default_rng(0).standard_normal(1200)
    signals = {("p", Tap.CMD): shown, ("p", Tap.MEAS): reading}
    return Record.from_signals(time_s, signals, {"p": "m"}, {"history": history})


def left(effects, record):
    evidence = Evidence.of(ROBOT, "p", [record])
    return float(np.sqrt(np.mean(evidence.residual(effects) ** 2)))


HIGH = np.concatenate([np.linspace(0.0, 4.6e-5, 400), np.full(2000, 4.6e-5)])


@pytest.mark.parametrize("effects", [(LOOP,), (CREEP,), (LOOP, CREEP)])
def test_what_came_before_is_no_gap_where_the_history_is_unknown(effects):
    assert left(effects, recorded(effects, HIGH, "unknown")) < 1.5
    assert left(effects, recorded(effects, HIGH, "known")) > 3.0


def test_a_model_without_the_effect_still_leaves_it():
    assert left((), recorded((LOOP,), HIGH, "unknown")) > 5.0


def test_memory_is_no_excuse_for_what_another_effect_does():
    """A clock hardly off hardly differs by its start: no amount of that makes a lag."""
    late = AxisEffect(axis="p", id="delay", parameters={"delay": 0.02})
    skewed = AxisEffect(axis="p", id="clock_skew", parameters={"skew": 40.0})
    record = recorded((late,), HIGH, "unknown")
    assert left((skewed,), record) > 0.9 * left((), record)


PIEZO = load_robot("rotemina")
WIDE_LOOP = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 1e-5, "shape": 1.0})


FALL = np.linspace(PIEZO.axes["zn"].range[1], 3e-5, 2000)
SHOWN = 3e-5 + 8e-6 * np.sin(2.0 * np.pi * 1.5 * np.arange(2000) / 1000.0)
TWICE = SHOWN  # what the record shows was done once before


def resumed(way=FALL):
    """A record of small swings of a ringing axis that came slowly on a way (2000,), SI."""
    path = np.concatenate([way, np.full(1000, 3e-5), SHOWN])
    asked = Record.from_signals(np.arange(5000) / 1000.0, {("zn", Tap.CMD): path}, {"zn": "m"})
    whole = simulate(PIEZO, [WIDE_LOOP], asked, np.random.default_rng(2))
    signals = {("zn", tap): whole.signal("zn", tap)[3000:] for tap in (Tap.CMD, Tap.MEAS)}
    return Record.from_signals(whole.time_s[3000:], signals, {"zn": "m"}, {"history": "unknown"})


def test_an_axis_that_came_from_the_high_end_neither_rings_nor_is_off():
    evidence = Evidence.of(PIEZO, "zn", [resumed()])
    floors = np.abs(evidence.residual((WIDE_LOOP,)))
    assert floors.max() < 6.0  # from the first row on
    assert floors.mean() < 0.9


def test_an_axis_that_made_the_same_motion_before_is_hardly_off():
    """As in an experiment that is repeated: its memory must not leave room for another cause."""
    residual = Evidence.of(PIEZO, "zn", [resumed(TWICE)]).residual((WIDE_LOOP,))
    assert np.mean(residual**2) < 2.0


def test_answers_remember_what_suits_a_record_best():
    evidence = Evidence.of(PIEZO, "zn", [resumed()])
    real = evidence.observations[0].real[Tap.MEAS]
    (plain,), (remembering,) = (
        ask((WIDE_LOOP,)) for ask in (evidence.response, evidence.remembering)
    )
    off, near = (np.std(real - one[Tap.MEAS]) for one in (plain, remembering))
    assert near < 0.05 * off


def test_other_starts_are_simulated_no_farther_than_they_matter(monkeypatch):
    late = AxisEffect(axis="zn", id="amplifier_lag", parameters={"time_constant": 2e-3})
    evidence = Evidence.of(PIEZO, "zn", [resumed()])
    rows = []
    advance = Plant.advance

    def counted(plant, state, time_s, *args, **options):
        rows.append(len(time_s))
        return advance(plant, state, time_s, *args, **options)

    monkeypatch.setattr(Plant, "advance", counted)
    short = evidence.residual((late,))
    simulated = sum(rows)
    rows.clear()
    monkeypatch.setattr("rotemina.sim.gap.fit.evidence._FORGETS", 1)
    whole = evidence.residual((late,))
    assert simulated < 0.6 * sum(rows)
    assert np.abs(short - whole).max() < 0.1
