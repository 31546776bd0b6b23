"""The virtual boards accept all commands of the fault catalogue."""

import pytest

from rotemina.drivers.virtual_board import VirtualBoards, inject_fault
from rotemina.plugins.faults.fault_catalogue import (
    ChoiceParameter,
    NumberParameter,
    list_injectable_faults,
)
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
FAULTS = {fault.title: fault for fault in list_injectable_faults(AXES, ("x", "y", "z"), 2)}


def make_arguments(fault, choice_index):
    """Return the arguments of a fault, with the choice of an index or the last choice."""
    return tuple(
        parameter.options[min(choice_index, len(parameter.options) - 1)][1]
        if isinstance(parameter, ChoiceParameter)
        else parameter.format_for_command(parameter.default)
        for parameter in fault.parameters
    )


@pytest.mark.parametrize("title", FAULTS)
def test_boards_accept_every_choice(title):
    fault = FAULTS[title]
    boards = VirtualBoards(ROBOT, ports=2)
    for choice_index in range(
        max(
            len(parameter.options)
            for parameter in fault.parameters
            if isinstance(parameter, ChoiceParameter)
        )
    ):
        inject_fault(boards, fault.make_command(make_arguments(fault, choice_index)))
    assert boards.notes.take_events()


@pytest.mark.parametrize("bound", ["low", "high"])
def test_boards_accept_both_bounds_of_every_number(bound):
    boards = VirtualBoards(ROBOT, ports=2)
    for fault in FAULTS.values():
        arguments = list(make_arguments(fault, 0))
        for index, parameter in enumerate(fault.parameters):
            if isinstance(parameter, NumberParameter):
                arguments[index] = parameter.format_for_command(getattr(parameter, bound))
        inject_fault(boards, fault.make_command(tuple(arguments)))


def test_faults_of_missing_parts_are_not_offered():
    titles = [fault.title for fault in list_injectable_faults(("p",), (), 1)]
    assert "Stepper" not in titles
    (board,) = [fault for fault in list_injectable_faults(("p",), (), 1) if fault.title == "Board"]
    assert board.parameters[-1].options == (("board 1", "1"),)
