"""Narrowed ranges: valid for every path, never wider than the robot file, stored per file."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.session import load_ranges, motion_requests, store_ranges
from rotemina.app.settings import UserSettings
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
ZN = tuple(ROBOT.axes).index("zn")
LOW, HIGH = 20e-6, 45e-6
NARROWED_MESSAGE = "is outside 20 µm to 45 µm, its narrowed range"
TIME_S = 1e-3 * np.arange(1000)
SWING = np.sin(2.0 * np.pi * TIME_S) ** 2


@pytest.fixture
def machine(make_harness):
    harness = make_harness()
    harness.step(0.05, 3)
    harness.session.ranges.narrow("zn", LOW, HIGH)
    return harness


def make_path(end, start=32.5e-6):
    return Record.from_signals(
        TIME_S, {("zn", Tap.CMD): start + (end - start) * SWING}, {"zn": "m"}
    )


def test_every_path_stays_within_a_narrowed_range(machine):
    session = machine.session
    before = session.snapshot().command["zn"]
    rising_profile = MotionProfile("zn", (ProfileSegment(0.5, 0.0, 45e-6, -30e-6),))
    for request in (
        lambda: session.go_to({"zn": 46e-6}),
        lambda: session.jog("zn", -13e-6),
        lambda: session.go_safely({"zn": 19e-6}),
        lambda: session.play(make_path(46e-6)),
        lambda: session.check_play(make_path(46e-6)),
        lambda: session.profiles.upload(rising_profile),
        lambda: session.profiles.check_thrust("zn", (before, 19e-6), 1e-5),
        lambda: session.set_voltage("zn", 46e-6 / ROBOT.axes["zn"].gain),
    ):
        with pytest.raises(OutOfLimitsError, match=NARROWED_MESSAGE):
            request()
    session.play(make_path(45e-6))
    machine.settle()
    session.go_to({"zn": HIGH})
    machine.settle()
    assert session.snapshot().command["zn"] == pytest.approx(HIGH)


@pytest.mark.parametrize(("speed", "end"), [(1e-3, HIGH), (-1e-3, LOW)])
def test_a_speed_ends_inside_the_narrowed_range(machine, speed, end):
    session, portions = machine.session, []
    session.tap(lambda samples, _: portions.append(samples.command[:, ZN]))
    for _ in range(20):
        session.move_velocity({"zn": speed}, 0.15)
        machine.step(0.05)
    machine.settle()
    command = np.concatenate(portions)
    assert command.min() >= LOW
    assert command.max() <= HIGH
    assert abs(command[-1] - end) < 0.5e-6


def test_it_is_never_wider_than_the_range_and_contains_the_position(machine):
    session = machine.session
    for ends, message in (
        ((10e-6, 66e-6), "outside its range"),
        ((-1e-6, 50e-6), "outside its range"),
        ((40e-6, 30e-6), "the low end must be lower"),
        ((30e-6, 30e-6), "the low end must be lower"),
        ((float("nan"), 30e-6), "not a finite number"),
        ((40e-6, 50e-6), "is at 32.5 µm, outside 40 µm to 50 µm; move it inside first"),
    ):
        with pytest.raises(OutOfLimitsError, match=message):
            session.ranges.narrow("zn", *ends)
    assert session.ranges.find_range("zn") == (LOW, HIGH)
    session.ranges.narrow("zn", 10e-6, 60e-6)  # any range within that of the robot file is possible
    session.ranges.restore("zn")
    assert session.ranges.find_range("zn") == ROBOT.axes["zn"].range
    session.go_to({"zn": 64e-6})


def test_ranges_change_only_at_rest(machine):
    machine.session.jog("zn", 1e-6)
    for change in (
        lambda: machine.session.ranges.narrow("zn", 30e-6, 40e-6),
        lambda: machine.session.ranges.restore("zn"),
    ):
        with pytest.raises(RequestRefusedError, match="still moving"):
            change()


def test_a_path_is_refused_if_the_range_narrows_during_its_check(machine, monkeypatch):
    session, original_check = machine.session, motion_requests.check_rows

    def check_rows(*args):
        original_check(*args)
        session.ranges.narrow("zn", 30e-6, 40e-6)

    monkeypatch.setattr(motion_requests, "check_rows", check_rows)
    with pytest.raises(RequestRefusedError, match="have changed; play again"):
        session.play(make_path(45e-6))
    machine.settle()
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6)


def test_an_axis_outside_its_narrowed_range_may_only_move_inside(make_harness):
    harness = make_harness(connect=False)
    harness.session.ranges.set_initial_ranges({"zn": (40e-6, 50e-6)})
    harness.connect().step(0.05, 3)
    session = harness.session
    with pytest.raises(OutOfLimitsError, match="its narrowed range"):
        session.jog("zn", 1e-6)
    session.move_velocity({"zn": -1e-4}, 0.1)
    harness.settle()
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6)
    session.go_to({"zn": 45e-6})
    harness.settle()
    assert session.snapshot().command["zn"] == pytest.approx(45e-6)


def test_ranges_are_stored_per_robot_file_and_invalid_ones_refused(tmp_path, make_harness):
    settings = UserSettings(tmp_path / "settings.json")
    store_ranges(settings, ROBOT, {"zn": (LOW, HIGH)})
    assert load_ranges(UserSettings(tmp_path / "settings.json"), ROBOT) == {"zn": (LOW, HIGH)}
    assert load_ranges(settings, replace(ROBOT, name="another")) == {}
    session = make_harness(connect=False).session
    for bad_ranges in ({"zn": (LOW, 1.0)}, {"q": (LOW, HIGH)}):
        with pytest.raises(OutOfLimitsError):
            session.ranges.set_initial_ranges(bad_ranges)
    assert session.ranges.narrowed_ranges == {}
    (key,) = settings.values
    for text in ("{", '{"zn": [1]}', "[1]", '{"zn": ["a", 2]}'):
        settings.set(key, text)
        with pytest.raises(InputError, match="preference ranges"):
            load_ranges(settings, ROBOT)
