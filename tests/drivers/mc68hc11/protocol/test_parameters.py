"""Axes and parameters of the boards are whole numbers that match the robot file."""

import re
from itertools import chain
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11.protocol import (
    PARAMETERS_PER_AXIS,
    WriteParameter,
    compute_fingerprint,
    describe_parameter,
    make_board_axes,
    make_parameters,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot

ROBOTS = {name: load_robot(name) for name in ("rotemina", "picma", "fsm")}
PAGE = (Path(__file__).parents[4] / "docs" / "protocol.md").read_text("utf-8")


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_every_range_fits_into_telemetry(robot):
    for board_axis in chain.from_iterable(make_board_axes(robot)):
        axis = robot.axes[board_axis.name]
        description = board_axis.describe(robot)
        low, high = axis.range
        step_size = board_axis.step_size
        assert low <= board_axis.to_si(description.low) < low + step_size
        assert high - step_size < board_axis.to_si(description.high) <= high * (1 + 1e-12)
        assert -(2**23) <= description.low < description.high < 2**23
        assert step_size <= max(axis.sensor.resolution if axis.sensor else 0.0, axis.span / 2**15)


def test_the_step_sizes_of_the_shipped_robot_match_its_resolution():
    micro, nano = make_board_axes(ROBOTS["rotemina"])
    assert [axis.step_size for axis in micro] == [1e-7, 1e-7, 1e-7]
    assert [axis.step_size for axis in nano] == [2e-8, 2e-8, 1e-9]
    assert [axis.name for axis in (*micro, *nano)] == list(ROBOTS["rotemina"].axes)
    assert micro[0].to_si(123_457) == 0.0123457
    assert micro[0].to_steps(0.0123457) == 123_457


def test_parameters_fit_and_distinguish_robots():
    fingerprints = set()
    for robot in ROBOTS.values():
        for axes in make_board_axes(robot):
            values = make_parameters(robot, axes)
            assert len(values) == PARAMETERS_PER_AXIS * len(axes)
            for index, value in enumerate(values):
                WriteParameter(index, value).pack()
                assert describe_parameter(robot, axes, index).name.startswith(
                    axes[index // PARAMETERS_PER_AXIS].name
                )
            fingerprints.add(compute_fingerprint(values))
    assert len(fingerprints) == 4


def test_the_page_names_every_parameter():
    rows = re.findall(r"^\| (\d) \| (.*) \| (.*) \|$", PAGE, re.MULTILINE)
    micro, nano = make_board_axes(ROBOTS["rotemina"])
    for number, stepper, piezo in rows:
        for axes, parameter_text in ((micro, stepper), (nano, piezo)):
            name, unit = describe_parameter(ROBOTS["rotemina"], axes, int(number))
            assert parameter_text == ", ".join(filter(None, (name.split(": ")[1], unit))).replace(
                "the last code", "code 65535"
            )
    assert len(rows) == PARAMETERS_PER_AXIS


def test_an_axis_moved_by_a_force_is_refused():
    with pytest.raises(InputError, match="axis q is moved by a force"):
        make_board_axes(load_robot("emps"))
