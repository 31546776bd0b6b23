"""Hysteresis: loops, their width and the memory of reversals, at any speed."""

from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects import AxisProperties
from rotemina.sim.effects.hysteresis import HYSTERESIS, apply_bouc_wen
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

PICMA = load_robot("picma")
SPAN = 46.5e-6
NAMES = [formulation.name for formulation in HYSTERESIS.formulations]
PLAY_FORMULATIONS = [name for name in NAMES if name != "bouc_wen"]
every_formulation = pytest.mark.parametrize("formulation", NAMES)


def simulate_position(path, formulation, **parameters):
    """Return positions of a static axis for a path of commands, as shares of its range."""
    time_s = np.arange(len(path)) / 200.0
    record = Record.from_signals(time_s, {("p", Tap.CMD): SPAN * path}, {"p": "m"})
    effect = AxisEffect(axis="p", id="hysteresis", formulation=formulation, parameters=parameters)
    return simulate(PICMA, [effect], record).signal("p", Tap.REF) / SPAN


def make_path(*corners, points=200):
    """Return straight lines between the corners, with corner k at row ``k points``."""
    lines = [np.linspace(a, b, points + 1)[1:] for a, b in pairwise(corners)]
    return np.concatenate([[corners[0]], *lines])


def measure_width(low, high, formulation, **parameters):
    y = simulate_position(make_path(*[low, high] * 12), formulation, **parameters)
    return y[-301] - y[-101]  # downwards and upwards, after the loop has settled


@pytest.mark.parametrize("formulation", ["prandtl_ishlinskii", "modified_prandtl_ishlinskii"])
@pytest.mark.parametrize("shape", [0.7, 3.0])
def test_the_full_range_loop_has_its_width_and_a_gain_of_one(formulation, shape):
    parameters = {"width": 0.15 * SPAN, "shape": shape}
    if formulation != "prandtl_ishlinskii":
        parameters["asymmetry"] = 0.0
    assert measure_width(0, 1, formulation, **parameters) == pytest.approx(0.15, rel=1e-9)
    y = simulate_position(make_path(0, 1, 0), formulation, **parameters)
    assert y[200] - y[400] == pytest.approx(1.0, rel=1e-9)


def test_a_long_bouc_wen_loop_has_its_width():
    parameters = {"reach": 0.03 * SPAN, "asymmetry": 0.0, "width": 0.12 * SPAN}
    assert measure_width(0, 1, "bouc_wen", **parameters) == pytest.approx(0.12, rel=1e-3)


@every_formulation
def test_the_width_grows_faster_than_the_amplitude(formulation):
    small = measure_width(0.4, 0.6, formulation)
    assert measure_width(0.3, 0.7, formulation) > 2.5 * small


@pytest.mark.parametrize("formulation", PLAY_FORMULATIONS)
def test_minor_loops_close_and_are_forgotten(formulation):
    y = simulate_position(make_path(0, 0.8, 0.3, 0.6, 0.3, 0.1), formulation)
    assert y[800] == pytest.approx(y[400], abs=1e-12)  # back at 0.3: the loop is closed
    without_loop = simulate_position(make_path(0, 0.8, 0.1), formulation)
    assert y[-1] == pytest.approx(without_loop[-1], abs=1e-12)  # and it is forgotten beyond 0.8


def simulate_loop(formulation, history):
    y = simulate_position(make_path(*history, 0.3, 0.6, 0.3, 0.6, 0.3), formulation)[-401:]
    return y - y[0]


def test_loops_between_the_same_turns_are_congruent_only_without_dead_zones():
    histories = [(0.0, 1.0), (0.0, 0.6, 0.0)]
    for formulation in ("prandtl_ishlinskii", "ten_plays"):
        first_loop, second_loop = (simulate_loop(formulation, history) for history in histories)
        np.testing.assert_allclose(first_loop, second_loop, atol=1e-12)
    first_loop, second_loop = (
        simulate_loop("modified_prandtl_ishlinskii", history) for history in histories
    )
    assert np.abs(first_loop - second_loop).max() > 1e-4


def test_plays_distort_oddly_and_asymmetry_distorts_evenly():
    path = 0.5 + 0.45 * np.sin(2 * np.pi * np.arange(4000) / 1000)
    even_to_odd = {}
    for formulation in NAMES:
        spectrum = np.abs(np.fft.rfft(simulate_position(path, formulation)[-1000:]))
        even_to_odd[formulation] = spectrum[2] / spectrum[3]
        assert spectrum[3] > 1e-3 * spectrum[1]
    assert even_to_odd["prandtl_ishlinskii"] < 1e-3
    assert min(even_to_odd["modified_prandtl_ishlinskii"], even_to_odd["bouc_wen"]) > 0.1


@every_formulation
def test_a_run_starts_as_after_a_rise_from_the_low_end(formulation):
    position_after_rise = simulate_position(make_path(0.0, 0.7, points=256), formulation)[-1]
    assert simulate_position(np.full(3, 0.7), formulation)[0] == pytest.approx(
        position_after_rise, abs=1e-9
    )


@every_formulation
@pytest.mark.parametrize("robot", ["rotemina", "fsm"])
def test_every_axis_begins_without_memory_at_its_low_end(formulation, robot):
    properties = AxisProperties.of(
        next(a for a in load_robot(robot).axes.values() if a.kind == "piezo")
    )
    model = HYSTERESIS.find_formulation(formulation)
    values = {p.name: p.preset(properties) for p in model.parameters}
    memory = [0.0] * model.acts.states
    numbers = list(model.compute_numbers(values, properties))
    assert model.acts.step(properties.low, 0, 0, 1e9, 0, 0, numbers, memory) == properties.low


@pytest.mark.parametrize("sharpness", [1.0, 3.0])
def test_bouc_wen_gives_the_same_for_coarse_and_fine_steps(sharpness):
    p = [0.0, 1.1, 0.05, 0.2, sharpness, 0.8, 0.3]
    coarse, fine = [0.0, 0.0], [0.0, 0.0]
    for a, b in ((0.0, 0.9), (0.9, 0.2), (0.2, 0.5), (0.5, 0.0)):
        y = apply_bouc_wen(b, 0, 0, 1.0, 0, 0, p, coarse)
        for x in np.linspace(a, b, 2001)[1:]:
            z = apply_bouc_wen(x, 0, 0, 1.0, 0, 0, p, fine)
        assert y == pytest.approx(z, abs=2e-6)


def test_the_first_rise_of_bouc_wen_is_an_exact_exponential():
    p, s = [0.0, 1.0, 0.5, 0.25, 1.0, 1.0, 0.0], [0.0, 0.0]
    y = apply_bouc_wen(0.6, 0, 0, 1.0, 0, 0, p, s)
    assert y == pytest.approx(0.6 - 0.5 * (1 - np.exp(-0.6 / 0.25)), abs=1e-6)


def test_asymmetry_of_bouc_wen_differs_upwards_and_downwards():
    parameters = [0.0, 1.0, 0.5, 0.03, 1.0, 1.0, 0.4]
    s = [0.0, 0.0]
    apply_bouc_wen(1.0, 0, 0, 1.0, 0, 0, parameters, s)
    assert s[0] == pytest.approx(1 / 1.4, abs=1e-6)
    apply_bouc_wen(0.0, 0, 0, 1.0, 0, 0, parameters, s)
    assert s[0] == pytest.approx(-1 / 0.6, abs=1e-5)
