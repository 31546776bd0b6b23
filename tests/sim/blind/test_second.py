"""The second generator: what it adds is there, and a machine without it is the nominal one."""

import numpy as np
import pytest

from rotemina.sim.blind_second.case import _machine, draw_second
from rotemina.sim.blind_second.effects import MAKERS, PIEZO_ALONE, draw
from rotemina.sim.blind_second.machine import Motion
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def machine_of(names, rows=1500):
    time_s = np.arange(rows) / 500.0
    ways = [ROBOT.axes[name].range for name in names]
    values = [
        low + min(high - low, 4e-3) * (0.5 + 0.4 * np.sin(7.0 * time_s + number))
        for number, (low, high) in enumerate(ways)
    ]
    asked = Motion(1.0 / 500.0, np.column_stack(values))
    return _machine(ROBOT, names, [asked]), asked


@pytest.mark.parametrize("names", [("x", "y", "z"), ("thx", "thy", "zn")])
def test_a_machine_with_nothing_added_is_the_nominal_one(names):
    machine, asked = machine_of(names)
    reading = machine.run(asked, 0).reading
    time_s = np.arange(len(reading)) * asked.step_s
    signals = {(name, Tap.CMD): asked.values[:, i] for i, name in enumerate(names)}
    units = {name: ROBOT.unit(name) for name in names}
    nominal = nominal_response(ROBOT, Record.from_signals(time_s, signals, units))
    for axis in machine.axes:
        apart = (reading[:, axis.index] - nominal.signal(axis.name, Tap.MEAS))[250:]
        assert np.std(apart) < 0.1 * axis.floor


@pytest.mark.parametrize("effect", [*MAKERS, "cross_coupling"])
def test_each_effect_changes_what_is_read(effect):
    names = ("thx", "thy", "zn") if effect in PIEZO_ALONE else ("x", "y", "z")
    machine, asked = machine_of(names)
    axis, *others = machine.axes
    one = draw(effect, axis, others, np.random.default_rng(0))
    plain, changed = (machine.having(e).run(asked, 1).reading for e in ([], [one.sized(one.usual)]))
    apart = changed - plain
    assert np.isfinite(apart).all()
    assert np.std(apart[:, axis.index]) > 0.05 * axis.floor


@pytest.mark.slow
def test_cases_are_drawn_labelled_and_written(tmp_path):
    cases = [draw_second(ROBOT, seed) for seed in (0, 1, 3)]
    for number, case in enumerate(cases):
        label = case.label()
        assert (label["verdict"] == "none") == (label["effects"] == [])
        assert all(effect["floors"] >= 1.6 for effect in label["effects"])
        if label["remainder"] is not None:
            rest = label["remainder"]["floors"]
            assert min(effect["floors"] for effect in label["effects"]) >= 2.0 * rest
        case.write(tmp_path / str(number), ROBOT)
        record = read_record(tmp_path / str(number) / "train_1.csv.gz", robot=ROBOT)
        assert record.has(record.axes[0], Tap.MEAS)
    assert draw_second(ROBOT, 1).label() == cases[1].label()


def test_chance_is_the_same_whatever_else_is_added():
    machine, asked = machine_of(("x",))
    axis = machine.axes[0]
    rng = np.random.default_rng(0)
    noise, gain = (draw(name, axis, [], rng) for name in ("sensor_noise", "sensor_gain"))
    noise = noise.sized(noise.usual)
    alone = machine.having([noise]).run(asked, 1).reading - machine.run(asked, 1).reading
    beside = machine.having([gain, noise]).run(asked, 1).reading - machine.run(asked, 1).reading
    assert beside == pytest.approx(alone, abs=1e-6 * axis.floor)
