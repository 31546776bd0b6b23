"""What all effects of the sensor have in common."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.effects.registry import effect_named
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import Simulation, simulate

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
    for formulation in effect_named(effect_id).formulations
]
NOTHING = {
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


def on(axis, effect_id, formulation, **parameters):
    if effect_id == "sensor_outliers":
        parameters = {"rate": 50.0} | parameters  # so that some fall into a short run
    return AxisEffect(axis=axis, id=effect_id, formulation=formulation, parameters=parameters)


def swept(axis="x", seconds=0.5):
    time_s = np.arange(int(seconds * RATE)) / RATE
    low, high = ROBOT.axes[axis].range
    travel = np.minimum(1.5e-3, 0.3 * (high - low))
    command = 0.5 * (low + high) + travel * np.sin(2 * np.pi * 5.0 * time_s**2)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: ROBOT.axes[axis].unit})


def looped(seconds=0.5):
    time_s = np.arange(int(seconds * RATE)) / RATE
    command = 0.1 + 0.02 * np.sin(2 * np.pi * 2.0 * time_s)
    return Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )


@every_effect
def test_the_reading_is_touched_and_the_reference_is_not(effect_id, formulation):
    commands = swept()
    clean = simulate(ROBOT, (), commands, np.random.default_rng(5))
    faulty = simulate(ROBOT, [on("x", effect_id, formulation)], commands, np.random.default_rng(5))
    gap = faulty.signal("x", Tap.REF) - clean.signal("x", Tap.REF)
    assert np.abs(gap).max() < 1e-15  # finer steps round otherwise
    assert np.abs(faulty.signal("x", Tap.MEAS) - clean.signal("x", Tap.MEAS)).max() > 5e-8


@every_effect
def test_its_nothing_value_is_the_nominal_response_exactly(effect_id, formulation):
    none = NOTHING.get(formulation) or NOTHING[effect_id]
    commands = swept()
    clean = simulate(ROBOT, (), commands, np.random.default_rng(5))
    same = simulate(
        ROBOT, [on("x", effect_id, formulation, **none)], commands, np.random.default_rng(5)
    )
    np.testing.assert_array_equal(same.signal("x", Tap.MEAS), clean.signal("x", Tap.MEAS))


@every_effect
def test_one_seed_gives_one_answer_and_chance_is_absent_without(effect_id, formulation):
    commands = swept()
    effects = [on("x", effect_id, formulation)]

    def read(seed):
        return simulate(ROBOT, effects, commands, np.random.default_rng(seed)).signal("x", Tap.MEAS)

    np.testing.assert_array_equal(read(1), read(1))
    assert np.any(read(1) != read(2))
    random = effect_id in {"sensor_noise", "sensor_drift", "sensor_outliers"}
    clean = simulate(ROBOT, (), commands).signal("x", Tap.MEAS)
    silent = simulate(ROBOT, effects, commands).signal("x", Tap.MEAS)
    assert np.array_equal(silent, clean) == random


@every_effect
def test_a_run_in_pieces_is_the_run_at_once(effect_id, formulation):
    commands = swept("thx" if effect_id != "encoder_interpolation" else "x")
    (axis,) = commands.axes
    effects = [on(axis, effect_id, formulation)]
    whole = simulate(ROBOT, effects, commands, np.random.default_rng(3))
    pieces = Simulation(ROBOT, effects, commands, np.random.default_rng(3))
    edges = [0, 1, 2, 3, 5, 8, 40, 41, 333, len(commands.time_s)]
    taken = [pieces.follow(commands.part(slice(begin, end))) for begin, end in pairwise(edges)]
    joined = np.concatenate([piece.signal(axis, Tap.MEAS) for piece in taken])
    gap = np.abs(joined - whole.signal(axis, Tap.MEAS))
    step = ROBOT.axes[axis].sensor.resolution  # rounding may tip a reading by one step
    assert np.count_nonzero(gap > 1e-12) <= 2
    assert gap.max() <= 1.001 * step


# A loop is closed by samples, whatever a skewed clock stamps on them.
@pytest.mark.parametrize(("effect_id", "formulation"), EFFECTS[:-1])
def test_a_controller_acts_upon_the_sensors_fault(effect_id, formulation):
    commands = looped()
    clean = simulate(EMPS, (), commands, np.random.default_rng(2))
    faulty = simulate(EMPS, [on("q", effect_id, formulation)], commands, np.random.default_rng(2))
    assert np.ptp(faulty.signal("q", Tap.U) - clean.signal("q", Tap.U)) > 1e-3
    assert np.ptp(faulty.signal("q", Tap.REF) - clean.signal("q", Tap.REF)) > 1e-9


@every_effect
def test_it_starts_at_rest(effect_id, formulation):
    time_s = np.arange(100) / RATE
    command = np.full(100, 0.0123456)
    commands = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    reading = simulate(ROBOT, [on("x", effect_id, formulation)], commands).signal("x", Tap.MEAS)
    assert np.ptp(reading) < 1e-15


def test_effects_of_a_robot_file_can_stand_in_a_row():
    commands = swept()
    both = [
        on("x", "sensor_gain", None, error=0.1),
        on("x", "sensor_quantization", None, step=2e-5),
    ]
    reading = simulate(ROBOT, both, commands).signal("x", Tap.MEAS)
    true = simulate(ROBOT, (), commands).signal("x", Tap.MEAS)
    np.testing.assert_allclose(reading, 2e-5 * np.rint(1.1 * true / 2e-5), atol=1e-15)
    offset = replace(ROBOT.axes["x"], offset=1e-3)
    shifted = replace(ROBOT, axes={**ROBOT.axes, "x": offset})
    moved = simulate(shifted, both, commands).signal("x", Tap.MEAS)
    np.testing.assert_allclose(moved, 2e-5 * np.rint((1.1 * true + 1e-3) / 2e-5), atol=1e-15)


def test_a_skewed_clock_leaves_a_closed_loop_alone():
    commands = looped()
    clean = simulate(EMPS, (), commands)
    skewed = simulate(EMPS, [on("q", "clock_skew", None, skew=5000.0)], commands)
    np.testing.assert_array_equal(skewed.signal("q", Tap.U), clean.signal("q", Tap.U))
    assert np.any(skewed.signal("q", Tap.MEAS) != clean.signal("q", Tap.MEAS))
