"""Where the fit of an effect begins."""

import sys
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.fit_starts import starts
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from sweeps import ROBOT, sweep


def fitted(truth, axes=("x",), **motion):
    evidence = Evidence.of(ROBOT, truth.axis, [sweep([truth], axes, **motion)])
    bare = AxisEffect(
        axis=truth.axis, id=truth.id, formulation=truth.formulation, from_axis=truth.from_axis
    )
    nothing = fit(evidence, [])
    begun = starts(evidence, nothing, bare)
    return min((fit(evidence, [start]) for start in begun), key=lambda one: one.cost)


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
def test_a_fit_finds_what_cannot_be_found_downhill_from_the_preset(truth, axes):
    found = fitted(truth, axes)
    assert found.cost == pytest.approx(1.0, abs=0.2)
    for name, value in truth.parameters.items():
        assert found.effects[0].parameters[name] == pytest.approx(value, rel=0.05), name


@pytest.mark.slow
def test_the_grid_of_a_thousand_steps_is_found_to_a_part_of_one():
    truth = AxisEffect(axis="x", id="quantization", parameters={"step": 2.713e-6, "shift": 0.31})
    slow = sweep([truth], seconds=40.0, share=0.002)
    evidence = Evidence.of(ROBOT, "x", [slow, sweep([truth], seconds=40.0, share=0.02, seed=1)])
    bare = AxisEffect(axis="x", id="quantization")
    begun = starts(evidence, fit(evidence, []), bare)
    left = [float(np.mean(evidence.residual([start]) ** 2)) for start in begun]
    assert min(left) < 0.1 * float(np.mean(evidence.residual() ** 2))
    assert begun[int(np.argmin(left))].parameters["step"] == pytest.approx(2.713e-6, rel=1e-4)


def test_a_skewed_clock_is_found_where_rows_hardly_sample_what_rings():
    truth = AxisEffect(axis="thx", id="clock_skew", parameters={"skew": 800.0})
    time_s = np.arange(4000) / 500.0
    steps = ROBOT.axes["thx"].range[0] + ROBOT.axes["thx"].span * np.where(time_s % 2 < 1, 0.3, 0.6)
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): steps}, {"thx": "rad"})
    finely = np.arange(64000) / 8000.0
    held = Record.from_signals(finely, {("thx", Tap.CMD): np.repeat(steps, 16)}, {"thx": "rad"})
    ringing = simulate(ROBOT, [], held).signal("thx", Tap.MEAS)
    reading = np.interp(time_s * (1.0 - 8e-4), finely, ringing)
    noise = ROBOT.axes["thx"].sensor.noise_rms * np.random.default_rng(0).standard_normal(4000)
    signals = {("thx", Tap.CMD): steps, ("thx", Tap.MEAS): reading + noise}
    evidence = Evidence.of(
        ROBOT, "thx", [Record.from_signals(commands.time_s, signals, {"thx": "rad"})]
    )
    found = fit(evidence, starts(evidence, fit(evidence, []), truth)[:1])
    assert found.effects[0].parameters["skew"] == pytest.approx(800.0, rel=0.01)
    assert found.cost < 1.3
