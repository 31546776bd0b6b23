"""The commands of fault injection are those that the virtual boards take."""

import pytest

from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.drivers.virtual_board.fault_injection import inject
from rotemina.plugins.faults.fault_catalogue import Number, Pick, faults
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
FAULTS = {fault.title: fault for fault in faults(AXES, ("x", "y", "z"), 2)}


def words(fault, place):
    """Return a command with the choice at a place, the last one where there are fewer."""
    return tuple(
        each.words[min(place, len(each.words) - 1)][1]
        if isinstance(each, Pick)
        else each.word(each.preset)
        for each in fault.parameters
    )


@pytest.mark.parametrize("title", FAULTS)
def test_boards_understand_every_choice(title):
    fault = FAULTS[title]
    boards = VirtualBoards(ROBOT, ports=2)
    for place in range(max(len(each.words) for each in fault.parameters if isinstance(each, Pick))):
        inject(boards, fault.command(words(fault, place)))
    assert boards.notes.taken()


@pytest.mark.parametrize("end", ["low", "high"])
def test_boards_understand_both_ends_of_every_number(end):
    boards = VirtualBoards(ROBOT, ports=2)
    for fault in FAULTS.values():
        given = list(words(fault, 0))
        for place, each in enumerate(fault.parameters):
            if isinstance(each, Number):
                given[place] = each.word(getattr(each, end))
        inject(boards, fault.command(tuple(given)))


def test_what_a_robot_has_not_is_not_offered():
    titles = [fault.title for fault in faults(("p",), (), 1)]
    assert "Stepper" not in titles
    (board,) = [fault for fault in faults(("p",), (), 1) if fault.title == "Board"]
    assert board.parameters[-1].words == (("board 1", "1"),)
