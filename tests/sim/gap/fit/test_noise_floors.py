"""Noise floors of sensors without declared noise."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.noise_floors import floors, unforetold
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

TIME_S = np.arange(5000) * 1e-3


def test_noise_is_distinguished_from_motion_and_steps():
    noise = np.random.default_rng(0).standard_normal(5000)
    smooth = 1e3 * np.sin(2.0 * np.pi * 3.0 * TIME_S)
    steps = 50.0 * (np.floor(TIME_S) % 2.0)
    assert unforetold(noise + smooth + steps) == pytest.approx(1.0, rel=0.1)


def test_computed_or_short_signals_have_no_noise():
    assert unforetold(np.ones(5000)) is None
    assert unforetold(np.random.default_rng(0).standard_normal(50)) is None
    assert unforetold(np.random.default_rng(0).standard_normal(100)) == pytest.approx(1.0, rel=0.3)


def make_record(axis, mode):
    rng = np.random.default_rng(1)
    path = 0.1 + 0.05 * np.sin(2.0 * np.pi * TIME_S)
    return Record.from_signals(
        TIME_S,
        {
            (axis, Tap.CMD): path,
            (axis, Tap.U): 1e-2 * rng.standard_normal(5000),
            (axis, Tap.MEAS): path + 1e-7 * rng.standard_normal(5000),
        },
        {axis: "m"},
        {"mode": mode},
    )


@pytest.mark.parametrize(
    ("mode", "tap", "floor"), [("closed_loop", Tap.U, 1e-2), ("open_loop", Tap.MEAS, 1e-7)]
)
def test_only_the_response_has_a_floor_and_not_the_signal_that_drives_the_model(mode, tap, floor):
    """Under a controller, a sensor without declared noise drives the model."""
    floor_by_tap = floors(load_robot("emps"), make_record("q", mode), "q")
    assert floor_by_tap == {tap: pytest.approx(floor, rel=0.1)}


def test_a_vibration_at_rest_does_not_raise_the_noise_floor():
    rng = np.random.default_rng(2)
    path = np.interp(TIME_S, [0.0, 1.0, 5.0], [0.05, 0.1, 0.1])
    vibrating_effort = 0.1 * np.sin(2.0 * np.pi * 11.0 * TIME_S) + 1e-2 * rng.standard_normal(5000)
    record = Record.from_signals(
        TIME_S,
        {("q", Tap.CMD): path, ("q", Tap.U): vibrating_effort, ("q", Tap.MEAS): path},
        {"q": "m"},
        {"mode": "closed_loop"},
    )
    assert floors(load_robot("emps"), record, "q")[Tap.U] == pytest.approx(1e-2, rel=0.2)


def test_a_computed_voltage_that_repeats_itself_has_no_floor():
    robot = load_robot("rotemina")
    period = 3e-5 + 1e-5 * np.sin(2.0 * np.pi * TIME_S[:2500] / 2.5)
    path = np.tile(period, 2)
    rng = np.random.default_rng(2)
    record = Record.from_signals(
        TIME_S,
        {
            ("zn", Tap.CMD): path,
            ("zn", Tap.U): path / 5e-7,
            ("zn", Tap.MEAS): path + 1e-8 * rng.standard_normal(5000),
        },
        {"zn": "m"},
        {"history": "periodic", "period_samples": "2500"},
    )
    assert set(floors(robot, record, "zn")) == {Tap.MEAS}
