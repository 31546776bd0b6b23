"""Hysteresis: loops, their width, memory of reversals, at any pace."""

from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.hysteresis import HYSTERESIS, bouc_wen
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

PICMA = load_robot("picma")
SPAN = 46.5e-6
NAMES = [formulation.name for formulation in HYSTERESIS.formulations]
PLAYS = [name for name in NAMES if name != "bouc_wen"]
every = pytest.mark.parametrize("formulation", NAMES)


def followed(path, formulation, pace=1, rate_hz=200.0, **parameters):
    """Positions of a static axis on a path of commands, as shares of its range."""
    command = SPAN * np.repeat(path, pace)
    time_s = np.arange(len(command)) / rate_hz
    record = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"})
    effect = AxisEffect(axis="p", id="hysteresis", formulation=formulation, parameters=parameters)
    return simulate(PICMA, [effect], record).signal("p", Tap.REF)[pace - 1 :: pace] / SPAN


def through(*corners, points=200):
    """Straight ways between the corners; corner k is at ``k points``."""
    ways = [np.linspace(a, b, points + 1)[1:] for a, b in pairwise(corners)]
    return np.concatenate([[corners[0]], *ways])


def width_at_middle(low, high, formulation, **parameters):
    y = followed(through(*[low, high] * 12), formulation, **parameters)
    return y[-301] - y[-101]  # on the way down and up again, once the loop has settled


@pytest.mark.parametrize("formulation", ["prandtl_ishlinskii", "modified_prandtl_ishlinskii"])
@pytest.mark.parametrize("shape", [0.7, 1.0, 3.0])
def test_the_loop_from_end_to_end_has_its_width_and_a_gain_of_one(formulation, shape):
    own = {"width": 0.15 * SPAN, "shape": shape}
    if formulation != "prandtl_ishlinskii":
        own["asymmetry"] = 0.0
    assert width_at_middle(0, 1, formulation, **own) == pytest.approx(0.15, rel=1e-9)
    y = followed(through(0, 1, 0), formulation, **own)
    assert y[200] - y[400] == pytest.approx(1.0, rel=1e-9)


def test_a_long_bouc_wen_loop_has_its_width():
    own = {"reach": 0.03 * SPAN, "asymmetry": 0.0, "width": 0.12 * SPAN}
    assert width_at_middle(0, 1, "bouc_wen", **own) == pytest.approx(0.12, rel=1e-3)


@every
def test_the_loop_turns_so_that_energy_is_lost(formulation):
    for low, high in ((0, 1), (0.3, 0.6), (0.5, 0.6)):
        assert width_at_middle(low, high, formulation) > 0


@every
def test_width_grows_faster_than_amplitude(formulation):
    small = width_at_middle(0.4, 0.6, formulation)
    assert width_at_middle(0.3, 0.7, formulation) > 2.5 * small


@every
def test_the_same_trace_at_any_pace(formulation):
    path = through(0.1, 0.8, 0.3, 0.6, points=50)
    np.testing.assert_allclose(
        followed(path, formulation), followed(path, formulation, pace=7), atol=1e-12
    )


@pytest.mark.parametrize("formulation", PLAYS)
def test_minor_loops_close_and_are_wiped_out(formulation):
    y = followed(through(0, 0.8, 0.3, 0.6, 0.3, 0.1), formulation)
    assert y[800] == pytest.approx(y[400], abs=1e-12)  # back at 0.3: the loop is closed
    plain = followed(through(0, 0.8, 0.1), formulation)
    assert y[-1] == pytest.approx(plain[-1], abs=1e-12)  # and forgotten beyond it


def loop(formulation, before):
    y = followed(through(*before, 0.3, 0.6, 0.3, 0.6, 0.3), formulation)[-401:]
    return y - y[0]


def test_loops_between_the_same_turns_are_congruent_only_without_dead_zones():
    histories = [(0.0, 1.0), (0.0, 0.6, 0.0)]
    for formulation in ("prandtl_ishlinskii", "ten_plays"):
        above, below = (loop(formulation, before) for before in histories)
        np.testing.assert_allclose(above, below, atol=1e-12)
    above, below = (loop("modified_prandtl_ishlinskii", before) for before in histories)
    assert np.abs(above - below).max() > 1e-4


def test_odd_distortion_of_plays_and_even_one_of_asymmetry():
    path = 0.5 + 0.45 * np.sin(2 * np.pi * np.arange(4000) / 1000)
    ratio = {}
    for formulation in NAMES:
        lines = np.abs(np.fft.rfft(followed(path, formulation)[-1000:]))
        ratio[formulation] = lines[2] / lines[3]
        assert lines[3] > 1e-3 * lines[1]
    assert ratio["prandtl_ishlinskii"] < 1e-3
    assert min(ratio["modified_prandtl_ishlinskii"], ratio["bouc_wen"]) > 0.1


@every
def test_no_width_is_nominal(formulation):
    none = {"width": 0.0}
    if formulation == "ten_plays":
        none = {f"weight_{i}": 0.0 for i in range(1, 11)}
    if formulation == "modified_prandtl_ishlinskii":
        none["asymmetry"] = 0.0
    path = through(0.2, 0.9, 0.1, 0.5)
    np.testing.assert_allclose(followed(path, formulation, **none), path, atol=1e-14)


@every
def test_a_run_starts_as_after_a_rise_from_the_low_end(formulation):
    risen = followed(through(0.0, 0.7, points=256), formulation)[-1]
    assert followed(np.full(3, 0.7), formulation)[0] == pytest.approx(risen, abs=1e-9)


@every
@pytest.mark.parametrize("robot", ["rotemina", "fsm"])
def test_every_axis_begins_unwound_at_its_low_end(formulation, robot):
    facts = Facts.of(next(a for a in load_robot(robot).axes.values() if a.kind == "piezo"))
    chosen = HYSTERESIS.formulation(formulation)
    values = {p.name: p.preset(facts) for p in chosen.parameters}
    memory = [0.0] * chosen.acts.states
    numbers = list(chosen.numbers(values, facts))
    assert chosen.acts.step(facts.low, 0, 0, 1e9, 0, 0, numbers, memory) == facts.low


@pytest.mark.parametrize("sharpness", [1.0, 1.7, 3.0])
def test_bouc_wen_is_integrated_to_the_commands_steps(sharpness):
    p = [0.0, 1.1, 0.05, 0.2, sharpness, 0.8, 0.3]
    coarse, fine = [0.0, 0.0], [0.0, 0.0]
    for a, b in ((0.0, 0.9), (0.9, 0.2), (0.2, 0.5), (0.5, 0.0)):
        y = bouc_wen(b, 0, 0, 1.0, 0, 0, p, coarse)
        for x in np.linspace(a, b, 2001)[1:]:
            z = bouc_wen(x, 0, 0, 1.0, 0, 0, p, fine)
        assert y == pytest.approx(z, abs=2e-6)


def test_a_first_rise_of_bouc_wen_is_the_exact_exponential():
    p, s = [0.0, 1.0, 0.5, 0.25, 1.0, 1.0, 0.0], [0.0, 0.0]
    y = bouc_wen(0.6, 0, 0, 1.0, 0, 0, p, s)
    assert y == pytest.approx(0.6 - 0.5 * (1 - np.exp(-0.6 / 0.25)), abs=1e-6)


def test_asymmetry_of_bouc_wen_parts_up_from_down():
    own = [0.0, 1.0, 0.5, 0.03, 1.0, 1.0, 0.4]
    s = [0.0, 0.0]
    bouc_wen(1.0, 0, 0, 1.0, 0, 0, own, s)
    assert s[0] == pytest.approx(1 / 1.4, abs=1e-6)
    bouc_wen(0.0, 0, 0, 1.0, 0, 0, own, s)
    assert s[0] == pytest.approx(-1 / 0.6, abs=1e-5)
