"""Common properties of all sensor effects."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects import load_effect
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import SimulatedMachine, simulate

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps")
RATE = 2000.0
EFFECTS = [
    (effect_id, formulation.name)
    for effect_id in (
        "sensor_gain",
        "sensor_nonlinearity",
        "sensor_lag",
        "sensor_noise",
        "sensor_quantization",
        "sensor_drift",
        "sensor_outliers",
        "encoder_interpolation",
        "clock_skew",
    )
    for formulation in load_effect(effect_id).formulations
]
ZERO_PARAMETERS = {
    "sensor_gain": {"error": 0.0},
    "sensor_nonlinearity": {"bow": 0.0, "cubic": 0.0},
    "series": {"sine_1": 0.0},
    "sensor_lag": {"time_constant": 0.0},
    "sensor_noise": {"rms": 0.0},
    "sensor_quantization": {"step": 0.0},
    "random_walk": {"rate": 0.0},
    "flicker": {"level": 0.0},
    "sensor_outliers": {"rate": 0.0},
    "encoder_interpolation": {"sine": 0.0, "second_sine": 0.0},
    "clock_skew": {"skew": 0.0},
}
every_effect = pytest.mark.parametrize(("effect_id", "formulation"), EFFECTS)


def make_effect(axis, effect_id, formulation, **parameters):
    if effect_id == "sensor_outliers":
        # At this rate some outliers fall into a short run.
        parameters = {"rate": 50.0} | parameters
    return AxisEffect(axis=axis, id=effect_id, formulation=formulation, parameters=parameters)


def make_sweep(axis="x", seconds=0.5):
    """Return commands of a sine whose frequency rises."""
    time_s = np.arange(int(seconds * RATE)) / RATE
    low, high = ROBOT.axes[axis].range
    travel = np.minimum(1.5e-3, 0.3 * (high - low))
    command = 0.5 * (low + high) + travel * np.sin(2 * np.pi * 5.0 * time_s**2)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: ROBOT.axes[axis].unit})


def make_closed_loop_commands(seconds=0.5):
    time_s = np.arange(int(seconds * RATE)) / RATE
    command = 0.1 + 0.02 * np.sin(2 * np.pi * 2.0 * time_s)
    return Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )


@every_effect
def test_the_reading_changes_and_the_reference_does_not(effect_id, formulation):
    commands = make_sweep()
    clean = simulate(ROBOT, (), commands, np.random.default_rng(5))
    faulty = simulate(
        ROBOT, [make_effect("x", effect_id, formulation)], commands, np.random.default_rng(5)
    )
    gap = faulty.signal("x", Tap.REF) - clean.signal("x", Tap.REF)
    assert np.abs(gap).max() < 1e-15  # finer steps are rounded differently
    assert np.abs(faulty.signal("x", Tap.MEAS) - clean.signal("x", Tap.MEAS)).max() > 5e-8


@every_effect
def test_zero_parameters_give_exactly_the_nominal_response(effect_id, formulation):
    zero_parameters = ZERO_PARAMETERS.get(formulation) or ZERO_PARAMETERS[effect_id]
    commands = make_sweep()
    clean = simulate(ROBOT, (), commands, np.random.default_rng(5))
    nominal = simulate(
        ROBOT,
        [make_effect("x", effect_id, formulation, **zero_parameters)],
        commands,
        np.random.default_rng(5),
    )
    np.testing.assert_array_equal(nominal.signal("x", Tap.MEAS), clean.signal("x", Tap.MEAS))


@every_effect
def test_readings_depend_on_the_seed_and_without_seed_nothing_is_random(effect_id, formulation):
    commands = make_sweep()
    effects = [make_effect("x", effect_id, formulation)]

    def simulate_reading(seed):
        return simulate(ROBOT, effects, commands, np.random.default_rng(seed)).signal("x", Tap.MEAS)

    np.testing.assert_array_equal(simulate_reading(1), simulate_reading(1))
    assert np.any(simulate_reading(1) != simulate_reading(2))
    is_random = effect_id in {"sensor_noise", "sensor_drift", "sensor_outliers"}
    clean = simulate(ROBOT, (), commands).signal("x", Tap.MEAS)
    without_seed = simulate(ROBOT, effects, commands).signal("x", Tap.MEAS)
    assert np.array_equal(without_seed, clean) == is_random


@every_effect
def test_a_run_in_pieces_equals_the_run_at_once(effect_id, formulation):
    commands = make_sweep("thx" if effect_id != "encoder_interpolation" else "x")
    (axis,) = commands.axes
    effects = [make_effect(axis, effect_id, formulation)]
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(3))
    machine = SimulatedMachine(ROBOT, effects, commands, np.random.default_rng(3))
    edges = [0, 1, 2, 3, 5, 8, 40, 41, 333, len(commands.time_s)]
    pieces = [
        machine.follow(commands.select_rows(slice(begin, end))) for begin, end in pairwise(edges)
    ]
    joined = np.concatenate([piece.signal(axis, Tap.MEAS) for piece in pieces])
    gap = np.abs(joined - whole.signal(axis, Tap.MEAS))
    step = ROBOT.axes[axis].sensor.resolution  # rounding may tip a reading by one step
    assert np.count_nonzero(gap > 1e-12) <= 2
    assert gap.max() <= 1.001 * step


# Clock skew is left out: its time stamps do not affect the loop.
@pytest.mark.parametrize(("effect_id", "formulation"), EFFECTS[:-1])
def test_a_controller_responds_to_the_sensor_fault(effect_id, formulation):
    commands = make_closed_loop_commands()
    clean = simulate(EMPS, (), commands, np.random.default_rng(2))
    faulty = simulate(
        EMPS, [make_effect("q", effect_id, formulation)], commands, np.random.default_rng(2)
    )
    assert np.ptp(faulty.signal("q", Tap.U) - clean.signal("q", Tap.U)) > 1e-3
    assert np.ptp(faulty.signal("q", Tap.REF) - clean.signal("q", Tap.REF)) > 1e-9


@every_effect
def test_the_reading_starts_at_rest(effect_id, formulation):
    time_s = np.arange(100) / RATE
    command = np.full(100, 0.0123456)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    reading = simulate(ROBOT, [make_effect("x", effect_id, formulation)], commands).signal(
        "x", Tap.MEAS
    )
    assert np.ptp(reading) < 1e-15


def test_effects_of_one_axis_act_in_sequence():
    commands = make_sweep()
    effects = [
        make_effect("x", "sensor_gain", None, error=0.1),
        make_effect("x", "sensor_quantization", None, step=2e-5),
    ]
    reading = simulate(ROBOT, effects, commands).signal("x", Tap.MEAS)
    true = simulate(ROBOT, (), commands).signal("x", Tap.MEAS)
    np.testing.assert_allclose(reading, 2e-5 * np.rint(1.1 * true / 2e-5), atol=1e-15)
    offset = replace(ROBOT.axes["x"], offset=1e-3)
    shifted = replace(ROBOT, axes={**ROBOT.axes, "x": offset})
    shifted_reading = simulate(shifted, effects, commands).signal("x", Tap.MEAS)
    np.testing.assert_allclose(
        shifted_reading, 2e-5 * np.rint((1.1 * true + 1e-3) / 2e-5), atol=1e-15
    )


def test_a_skewed_clock_leaves_a_closed_loop_alone():
    commands = make_closed_loop_commands()
    clean = simulate(EMPS, (), commands)
    skewed = simulate(EMPS, [make_effect("q", "clock_skew", None, skew=5000.0)], commands)
    np.testing.assert_array_equal(skewed.signal("q", Tap.U), clean.signal("q", Tap.U))
    assert np.any(skewed.signal("q", Tap.MEAS) != clean.signal("q", Tap.MEAS))
