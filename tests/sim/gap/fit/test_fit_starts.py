"""Start values of the fit of an effect."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.fit import Evidence, fit, starts
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, simulate_sweep


def fit_from_starts(truth, axes=("x",), **motion):
    evidence = Evidence.of(ROBOT, truth.axis, [simulate_sweep([truth], axes, **motion)])
    candidate = AxisEffect(
        axis=truth.axis, id=truth.id, formulation=truth.formulation, from_axis=truth.from_axis
    )
    empty_fit = fit(evidence, [])
    start_effects = starts(evidence, empty_fit, candidate)
    return min((fit(evidence, [start]) for start in start_effects), key=lambda result: result.cost)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("truth", "axes"),
    [
        (
            AxisEffect(axis="x", id="leadscrew_error", parameters={"period": 3.7e-4, "sine": 2e-6}),
            ("x",),
        ),
        (
            AxisEffect(axis="x", id="vibration", parameters={"frequency": 23.4, "sine": 5e-7}),
            ("x",),
        ),
        (
            AxisEffect(
                axis="x",
                id="cross_coupling",
                formulation="static",
                from_axis="y",
                parameters={"k": -0.04},
            ),
            ("x", "y"),
        ),
        (
            AxisEffect(
                axis="zn",
                id="contact",
                formulation="spring",
                parameters={"place": 3.4e-5, "stiffness": 0.4},
            ),
            ("zn",),
        ),
    ],
    ids=lambda value: getattr(value, "id", None),
)
def test_a_fit_finds_minima_that_a_descent_from_the_preset_misses(truth, axes):
    result = fit_from_starts(truth, axes)
    assert result.cost == pytest.approx(1.0, abs=0.2)
    for name, value in truth.parameters.items():
        assert result.effects[0].parameters[name] == pytest.approx(value, rel=0.05), name


@pytest.mark.slow
def test_the_grid_of_a_thousand_steps_is_found_to_a_fraction_of_a_step():
    truth = AxisEffect(axis="x", id="quantization", parameters={"step": 2.713e-6, "shift": 0.31})
    slow_sweep = simulate_sweep([truth], seconds=20.0, share=0.002)
    evidence = Evidence.of(
        ROBOT, "x", [slow_sweep, simulate_sweep([truth], seconds=20.0, share=0.02, seed=1)]
    )
    candidate = AxisEffect(axis="x", id="quantization")
    start_effects = starts(evidence, fit(evidence, []), candidate)
    costs = [float(np.mean(evidence.residual([start]) ** 2)) for start in start_effects]
    assert min(costs) < 0.1 * float(np.mean(evidence.residual() ** 2))
    assert start_effects[int(np.argmin(costs))].parameters["step"] == pytest.approx(
        2.713e-6, rel=1e-4
    )


def test_a_skewed_clock_is_found_although_rows_hardly_sample_the_resonance():
    truth = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 800.0})
    time_s = np.arange(4000) / 500.0
    steps = ROBOT.axes["thx"].range[0] + ROBOT.axes["thx"].span * np.where(time_s % 2 < 1, 0.3, 0.6)
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): steps}, {"thx": "rad"})
    fine_time_s = np.arange(64000) / 8000.0
    fine_commands = Record.from_signals(
        fine_time_s, {("thx", Tap.CMD): np.repeat(steps, 16)}, {"thx": "rad"}
    )
    fine_reading = simulate(ROBOT, [], fine_commands).signal("thx", Tap.MEAS)
    reading = np.interp(time_s * (1.0 - 8e-4), fine_time_s, fine_reading)
    noise = ROBOT.axes["thx"].sensor.noise_rms * np.random.default_rng(0).standard_normal(4000)
    signals = {("thx", Tap.CMD): steps, ("thx", Tap.MEAS): reading + noise}
    evidence = Evidence.of(
        ROBOT, "thx", [Record.from_signals(commands.time_s, signals, {"thx": "rad"})]
    )
    result = fit(evidence, starts(evidence, fit(evidence, []), truth)[:1])
    assert result.effects[0].parameters["skew"] == pytest.approx(800.0, rel=0.01)
    assert result.cost < 1.3
