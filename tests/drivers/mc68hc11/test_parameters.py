"""Axes and parameters of the boards: whole numbers that say what the robot file says."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11.axes import board_axes
from rotemina.drivers.mc68hc11.host_messages import WriteParameter
from rotemina.drivers.mc68hc11.parameters import PER_AXIS, fingerprint, meaning, parameters_of
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot

ROBOTS = {name: load_robot(name) for name in ("rotemina", "picma", "fsm")}
PAGE = (Path(__file__).parents[3] / "docs" / "protocol.md").read_text("utf-8")


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_every_range_fits_into_what_telemetry_can_tell(robot):
    for own in (one for board in board_axes(robot) for one in board):
        axis = robot.axes[own.name]
        told = own.described(robot)
        low, high = axis.range
        assert low <= own.value(told.low) < low + own.step
        assert high - own.step < own.value(told.high) <= high * (1 + 1e-12)
        assert -(2**23) <= told.low < told.high < 2**23
        assert own.step <= max(axis.sensor.resolution if axis.sensor else 0.0, axis.span / 2**15)


def test_the_shipped_robot_counts_in_its_resolution():
    micro, nano = board_axes(ROBOTS["rotemina"])
    assert [axis.step for axis in micro] == [1e-7, 1e-7, 1e-7]
    assert [axis.step for axis in nano] == [2e-8, 2e-8, 1e-9]
    assert [axis.name for axis in (*micro, *nano)] == list(ROBOTS["rotemina"].axes)
    assert micro[0].value(123_457) == 0.0123457
    assert micro[0].steps(0.0123457) == 123_457


def test_parameters_fit_and_tell_robots_apart():
    prints = set()
    for robot in ROBOTS.values():
        for axes in board_axes(robot):
            values = parameters_of(robot, axes)
            assert len(values) == PER_AXIS * len(axes)
            for index, value in enumerate(values):
                WriteParameter(index, value).packed()
                assert meaning(robot, axes, index).name.startswith(axes[index // PER_AXIS].name)
            prints.add(fingerprint(values))
    assert len(prints) == 4


def test_the_page_names_every_parameter():
    rows = re.findall(r"^\| (\d) \| (.*) \| (.*) \|$", PAGE, re.MULTILINE)
    micro, nano = board_axes(ROBOTS["rotemina"])
    for number, stepper, piezo in rows:
        for axes, told in ((micro, stepper), (nano, piezo)):
            name, unit = meaning(ROBOTS["rotemina"], axes, int(number))
            assert told == ", ".join(filter(None, (name.split(": ")[1], unit))).replace(
                "the last code", "code 65535"
            )
    assert len(rows) == PER_AXIS


def test_an_axis_moved_by_a_force_is_refused():
    with pytest.raises(InputError, match="axis q is moved by a force"):
        board_axes(load_robot("emps"))
