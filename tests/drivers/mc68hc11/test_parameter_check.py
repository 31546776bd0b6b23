"""Writing parameters to boards, and checking afterwards what they have stored."""

from types import SimpleNamespace

import pytest

from rotemina.drivers.contract import Gate
from rotemina.drivers.mc68hc11.parameter_check import ParameterCheck
from rotemina.drivers.mc68hc11.protocol import (
    BoardIdentity,
    IdentifyBoard,
    ParameterValue,
    ReadParameter,
    WriteParameter,
    compute_fingerprint,
    make_board_axes,
    make_parameters,
)
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHANGED_INDICES = (0, 2)
REFUSAL_REASON = 3


class FakeBoard:
    """A board that can refuse a parameter, or only pretend to store it."""

    def __init__(self, address, axes):
        self.address, self.axes, self.state = address, axes, 0
        self.values = list(make_parameters(ROBOT, axes))
        self.refused_index = self.forgotten_index = None
        self.identity = self.make_identity()
        self.requests, self.messages = [], []
        self.dialogue = SimpleNamespace(ask=self.requests.append)

    def make_identity(self):
        fingerprint = compute_fingerprint(self.values)
        return BoardIdentity(1, 0, len(self.axes), 0, len(self.values), fingerprint, b"fake")

    def serve(self):
        while self.requests:
            request = self.requests.pop(0)
            self.messages.append(request.message)
            match request.message:
                case ReadParameter(index):
                    request.on_answer(ParameterValue(index, self.values[index]), 0.0)
                case WriteParameter(index) if index == self.refused_index:
                    request.on_refusal(REFUSAL_REASON)
                case WriteParameter(index, value):
                    if index != self.forgotten_index:
                        self.values[index] = value
                    request.on_answer(None, 0.0)
                case IdentifyBoard():
                    request.on_answer(self.make_identity(), 0.0)


@pytest.fixture
def boards():
    made = [FakeBoard(number, axes) for number, axes in enumerate(make_board_axes(ROBOT), start=1)]
    for index in CHANGED_INDICES:
        made[0].values[index] += 1
    made[0].identity = made[0].make_identity()
    return made


@pytest.fixture
def check(boards):
    parameter_check = ParameterCheck(ROBOT, boards)
    parameter_check.compare_fingerprints()
    boards[0].serve()
    assert [difference.index for difference in parameter_check.differences] == [*CHANGED_INDICES]
    return parameter_check


def write(check, boards):
    check.write_differences(Gate().permit())
    for board in boards:
        board.messages.clear()
    while any(board.requests for board in boards):
        for board in boards:
            board.serve()


def test_written_parameters_are_checked(check, boards):
    write(check, boards)
    assert check.differences == ()
    assert check.failure is None
    assert all(IdentifyBoard in map(type, board.messages) for board in boards)


@pytest.mark.parametrize("refused_index", CHANGED_INDICES)
def test_a_refused_parameter_is_reported_whatever_its_turn(check, boards, refused_index):
    boards[0].refused_index = refused_index
    write(check, boards)
    assert [difference.index for difference in check.differences] == [refused_index]
    assert check.failure.startswith("board 1 refused to set")
    assert all(IdentifyBoard in map(type, board.messages) for board in boards)


@pytest.mark.parametrize(("refused_index", "forgotten_index"), [CHANGED_INDICES, (2, 0)])
def test_a_parameter_that_was_not_stored_is_found_despite_a_refusal(
    check, boards, refused_index, forgotten_index
):
    boards[0].refused_index, boards[0].forgotten_index = refused_index, forgotten_index
    write(check, boards)
    assert check.failure == "board 1 did not store the written parameters"
    assert [difference.index for difference in check.differences] == [*CHANGED_INDICES]
