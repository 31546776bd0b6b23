"""Narrowed ranges: held on every path, never wider than the robot file's, kept with the file."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion import motion_requests
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.range_settings import keep_ranges, kept_ranges
from rotemina.app.settings import Settings
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
ZN = tuple(ROBOT.axes).index("zn")
LOW, HIGH = 20e-6, 45e-6
NARROWED = "is outside 20 µm to 45 µm, its narrowed range"
TIME_S = 1e-3 * np.arange(1000)
SWING = np.sin(2.0 * np.pi * TIME_S) ** 2


@pytest.fixture
def machine(make_stepped):
    stepped = make_stepped()
    stepped.step(0.05, 3)
    stepped.session.ranges.narrow("zn", LOW, HIGH)
    return stepped


def settle(stepped):
    stepped.step(0.02, 2)
    while not stepped.session.at_rest:
        stepped.step(0.02)


def path(to, start=32.5e-6):
    return Record.from_signals(TIME_S, {("zn", Tap.CMD): start + (to - start) * SWING}, {"zn": "m"})


def test_every_path_is_held_within_it(machine):
    session = machine.session
    before = session.snapshot().command["zn"]
    rise = Profile("zn", (ProfileSegment(0.5, 0.0, 45e-6, -30e-6),))
    for act in (
        lambda: session.go_to({"zn": 46e-6}),
        lambda: session.jog("zn", -13e-6),
        lambda: session.go_safely({"zn": 19e-6}),
        lambda: session.play(path(46e-6)),
        lambda: session.check_play(path(46e-6)),
        lambda: session.profiles.upload(rise),
        lambda: session.profiles.check_thrust("zn", (before, 19e-6), 1e-5),
        lambda: session.set_voltage("zn", 46e-6 / ROBOT.axes["zn"].gain),
    ):
        with pytest.raises(OutOfLimitsError, match=NARROWED):
            act()
    session.play(path(45e-6))
    settle(machine)
    session.go_to({"zn": HIGH})
    settle(machine)
    assert session.snapshot().command["zn"] == pytest.approx(HIGH)


@pytest.mark.parametrize("speed", [1e-3, -1e-3, 1e-5])
def test_a_speed_ends_before_it_whatever_becomes_of_its_lease(machine, speed):
    session, seen = machine.session, []
    session.tap(lambda samples, _: seen.append(samples.command[:, ZN]))
    for _ in range(60):
        session.move_velocity({"zn": speed}, 0.15)
        machine.step(0.05)
    settle(machine)
    command = np.concatenate(seen)
    assert command.min() >= LOW
    assert command.max() <= HIGH
    if abs(speed) > 1e-4:
        end = HIGH if speed > 0.0 else LOW
        assert abs(command[-1] - end) < 0.5e-6


def test_it_is_never_wider_and_holds_where_the_axis_stands(machine):
    session = machine.session
    for ends, why in (
        ((10e-6, 66e-6), "outside its range"),
        ((-1e-6, 50e-6), "outside its range"),
        ((40e-6, 30e-6), "the low end must be lower"),
        ((30e-6, 30e-6), "the low end must be lower"),
        ((float("nan"), 30e-6), "not a finite number"),
        ((40e-6, 50e-6), "is at 32.5 µm, outside 40 µm to 50 µm; move it inside first"),
    ):
        with pytest.raises(OutOfLimitsError, match=why):
            session.ranges.narrow("zn", *ends)
    assert session.ranges.of("zn") == (LOW, HIGH)
    session.ranges.narrow("zn", 10e-6, 60e-6)  # within the robot file's it may be chosen anew
    session.ranges.restore("zn")
    assert session.ranges.of("zn") == ROBOT.axes["zn"].range
    session.go_to({"zn": 64e-6})


def test_it_changes_at_rest_alone(machine):
    machine.session.jog("zn", 1e-6)
    for change in (
        lambda: machine.session.ranges.narrow("zn", 30e-6, 40e-6),
        lambda: machine.session.ranges.restore("zn"),
    ):
        with pytest.raises(RefusedError, match="still moving"):
            change()


def test_a_range_that_narrows_while_a_path_is_checked_refuses_the_path(machine, monkeypatch):
    session, checked = machine.session, motion_requests.check_rows

    def check_rows(*asked):
        checked(*asked)
        session.ranges.narrow("zn", 30e-6, 40e-6)

    monkeypatch.setattr(motion_requests, "check_rows", check_rows)
    with pytest.raises(RefusedError, match="have changed; play again"):
        session.play(path(45e-6))
    settle(machine)
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6)


def test_an_axis_that_begins_outside_only_comes_in(make_stepped):
    stepped = make_stepped(connect=False)
    stepped.session.ranges.begin_with({"zn": (40e-6, 50e-6)})
    stepped.connect().step(0.05, 3)
    session = stepped.session
    with pytest.raises(OutOfLimitsError, match="its narrowed range"):
        session.jog("zn", 1e-6)
    session.move_velocity({"zn": -1e-4}, 0.1)
    settle(stepped)
    assert session.snapshot().command["zn"] == pytest.approx(32.5e-6)
    session.go_to({"zn": 45e-6})
    settle(stepped)
    assert session.snapshot().command["zn"] == pytest.approx(45e-6)


def test_it_is_kept_for_this_very_robot_file_and_what_is_none_is_refused(tmp_path, make_stepped):
    settings = Settings(tmp_path / "settings.json")
    keep_ranges(settings, ROBOT, {"zn": (LOW, HIGH)})
    assert kept_ranges(Settings(tmp_path / "settings.json"), ROBOT) == {"zn": (LOW, HIGH)}
    assert kept_ranges(settings, replace(ROBOT, name="another")) == {}
    session = make_stepped(connect=False).session
    for bad in ({"zn": (LOW, 1.0)}, {"q": (LOW, HIGH)}):
        with pytest.raises(OutOfLimitsError):
            session.ranges.begin_with(bad)
    assert session.ranges.narrowed == {}
    (key,) = settings.values
    for text in ("{", '{"zn": [1]}', "[1]", '{"zn": ["a", 2]}'):
        settings.set(key, text)
        with pytest.raises(InputError, match="preference ranges"):
            kept_ranges(settings, ROBOT)
