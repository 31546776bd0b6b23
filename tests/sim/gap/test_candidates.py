"""What may explain a gap, and where its fit begins."""

import numpy as np
import pytest

from rotemina.sim.gap.candidates import candidates
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import fit
from rotemina.sim.gap.models import beside, untouched
from rotemina.sim.gap.screening import screen
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


@pytest.mark.parametrize("period", [4e-6, 10e-6, 40e-6])
def test_the_period_of_a_grating_is_found_over_ways_of_any_length(period):
    numbers = {"period": period, "sine": -9e-8, "cosine": 2.3e-7, "second_cosine": -1.8e-7}
    truth = AxisEffect(axis="x", id="encoder_interpolation", parameters=numbers)
    ways = [sweep([truth], share=share, seed=seed) for seed, share in enumerate((4e-3, 0.08, 2e-3))]
    evidence = Evidence.of(ROBOT, "x", ways)
    bare = AxisEffect(axis="x", id="encoder_interpolation")
    found = screen(evidence, fit(evidence, []), bare, briefly=True)
    assert found.effect.parameters["period"] == pytest.approx(period, rel=1e-6)
    assert found.cost < 1.5


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


@pytest.mark.parametrize("centre", [-0.3, 0.17, 0.4])
def test_a_fit_from_a_first_look_finds_a_flexure_wherever_it_is_straight(centre):
    centre_m = centre * ROBOT.axes["zn"].span
    truth = AxisEffect(
        axis="zn",
        id="stiffness_nonlinearity",
        formulation="cubic",
        parameters={"hardening": 0.2, "centre": centre_m},
    )
    seen = [sweep([truth], ("zn",), share=share) for share in (0.45, -0.45)]
    evidence = Evidence.of(ROBOT, "zn", seen)
    bare = AxisEffect(axis="zn", id="stiffness_nonlinearity", formulation="cubic")
    look = screen(evidence, untouched(evidence).fit, bare, briefly=True)
    found = fit(evidence, beside(evidence, [look.effect]))
    assert found.effects[0].parameters["hardening"] == pytest.approx(0.2, rel=0.05)
    assert found.effects[0].parameters["centre"] == pytest.approx(centre_m, rel=0.05)


def test_a_delay_of_some_rings_is_found_among_the_minima_between_them():
    truth = AxisEffect(axis="zn", id="delay", parameters={"delay": 5.07e-3})
    time_s = np.arange(2400) / 4000.0
    own = ROBOT.axes["zn"]
    steps = own.range[0] + own.span * np.where(time_s % 0.2 < 0.1, 0.3, 0.6)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): steps}, {"zn": "m"})
    evidence = Evidence.of(
        ROBOT, "zn", [simulate(ROBOT, [truth], commands, np.random.default_rng(0))]
    )
    bare = AxisEffect(axis="zn", id="delay")
    found = screen(evidence, fit(evidence, []), bare, briefly=True)
    assert found.effect.parameters["delay"] == pytest.approx(5.07e-3, abs=1e-4)
    assert fit(evidence, [found.effect]).cost < 1.2
