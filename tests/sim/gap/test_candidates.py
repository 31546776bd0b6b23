"""What may explain a gap, and where its fit begins."""

import numpy as np
import pytest

from rotemina.sim.gap.candidates import candidates
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import fit
from rotemina.sim.gap.starts import starts
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def sweep(effects, axes=("x",), seconds=8.0, rate_hz=1000.0, share=0.05, seed=0):
    """Each axis there and back at its own pace, from rest to rest."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals, units = {}, {}
    for number, name in enumerate(axes):
        axis = ROBOT.axes[name]
        turn = 0.5 - 0.5 * np.cos(2 * np.pi * (number + 1) * time_s / seconds)
        signals[name, Tap.CMD] = sum(axis.range) / 2 + share * axis.span * turn
        units[name] = axis.unit
    commands = Record.from_signals(time_s, signals, units)
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))


def ids(found):
    return {candidate.id for candidate in found}


def test_every_effect_that_can_be_fitted_is_a_candidate():
    table = candidates(Evidence.of(ROBOT, "x", [sweep([])]))
    plate = candidates(Evidence.of(ROBOT, "thx", [sweep([], ("thx",))]))
    assert {"backlash", "friction", "microstep_error", "delay", "sensor_gain"} <= ids(table)
    assert {"hysteresis", "creep", "slew_limit", "saturation"} <= ids(plate)
    assert not {"hysteresis", "creep"} & ids(table)
    assert not {"backlash", "friction"} & ids(plate)
    assert not {"sensor_noise", "sensor_outliers", "lost_steps"} & (ids(table) | ids(plate))


def test_a_coupling_is_a_candidate_from_each_axis_that_was_commanded():
    found = candidates(Evidence.of(ROBOT, "x", [sweep([], ("x", "y", "thx"))]))
    sources = {one.from_axis for one in found if one.id == "cross_coupling"}
    assert sources == {"y", "thx"}
    assert "cross_coupling" not in ids(candidates(Evidence.of(ROBOT, "x", [sweep([])])))


def fitted(truth, axes=("x",), **motion):
    evidence = Evidence.of(ROBOT, truth.axis, [sweep([truth], axes, **motion)])
    bare = AxisEffect(
        axis=truth.axis, id=truth.id, formulation=truth.formulation, from_axis=truth.from_axis
    )
    nothing = fit(evidence, [])
    begun = starts(evidence, nothing, bare)
    return min((fit(evidence, [start]) for start in begun), key=lambda one: one.cost)


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
