"""The second generator: its effects show, and its machine without effects is the nominal one."""

import numpy as np
import pytest

from rotemina.sim.blind_second import draw_second_case
from rotemina.sim.blind_second.case import _build_machine
from rotemina.sim.blind_second.effects import DRAW_FUNCTIONS, PIEZO_ONLY_EFFECTS, draw_effect
from rotemina.sim.blind_second.machine import SecondMotion
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_machine(names, rows=1500):
    time_s = np.arange(rows) / 500.0
    ranges = [ROBOT.axes[name].range for name in names]
    values = [
        low + min(high - low, 4e-3) * (0.5 + 0.4 * np.sin(7.0 * time_s + number))
        for number, (low, high) in enumerate(ranges)
    ]
    motion = SecondMotion(1.0 / 500.0, np.column_stack(values))
    return _build_machine(ROBOT, names, [motion]), motion


@pytest.mark.parametrize("names", [("x", "y", "z"), ("thx", "thy", "zn")])
def test_a_machine_without_effects_is_the_nominal_machine(names):
    machine, motion = make_machine(names)
    reading = machine.run(motion, 0).reading
    time_s = np.arange(len(reading)) * motion.step_s
    signals = {(name, Tap.CMD): motion.values[:, i] for i, name in enumerate(names)}
    units = {name: ROBOT.unit(name) for name in names}
    nominal = simulate_nominal_response(ROBOT, Record.from_signals(time_s, signals, units))
    for axis in machine.axes:
        deviation = (reading[:, axis.index] - nominal.signal(axis.name, Tap.MEAS))[250:]
        assert np.std(deviation) < 0.1 * axis.floor


@pytest.mark.parametrize("effect", [*DRAW_FUNCTIONS, "cross_coupling"])
def test_each_effect_changes_the_reading(effect):
    names = ("thx", "thy", "zn") if effect in PIEZO_ONLY_EFFECTS else ("x", "y", "z")
    machine, motion = make_machine(names)
    axis, *others = machine.axes
    drawn_effect = draw_effect(effect, axis, others, np.random.default_rng(0))
    nominal, changed = (
        machine.with_effects(effects).run(motion, 1).reading
        for effects in ([], [drawn_effect.with_size(drawn_effect.usual_size)])
    )
    difference = changed - nominal
    assert np.isfinite(difference).all()
    assert np.std(difference[:, axis.index]) > 0.05 * axis.floor


@pytest.mark.slow
def test_cases_are_drawn_labelled_and_written(tmp_path):
    cases = [draw_second_case(ROBOT, seed) for seed in (0, 1)]
    for number, case in enumerate(cases):
        label = case.label()
        assert (label["verdict"] == "none") == (label["effects"] == [])
        assert all(effect["floors"] >= 1.6 for effect in label["effects"])
        if label["remainder"] is not None:
            remainder = label["remainder"]["floors"]
            assert min(effect["floors"] for effect in label["effects"]) >= 2.0 * remainder
        case.write(tmp_path / str(number), ROBOT)
        record = read_record(tmp_path / str(number) / "train_1.csv.gz", robot=ROBOT)
        assert record.has(record.axes[0], Tap.MEAS)
    assert draw_second_case(ROBOT, 1).label() == cases[1].label()


def test_noise_is_the_same_whichever_other_effects_are_added():
    machine, motion = make_machine(("x",))
    axis = machine.axes[0]
    rng = np.random.default_rng(0)
    noise, gain = (draw_effect(name, axis, [], rng) for name in ("sensor_noise", "sensor_gain"))
    noise = noise.with_size(noise.usual_size)
    alone, with_gain = (
        machine.with_effects(effects).run(motion, 1).reading for effects in ([noise], [gain, noise])
    )
    assert with_gain == pytest.approx(alone, abs=1e-6 * axis.floor)
