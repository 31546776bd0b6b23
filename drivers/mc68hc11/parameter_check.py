"""Whether the boards' parameters are those of the robot file, and what is done about it."""

from collections.abc import Sequence
from functools import partial

from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_messages import Identity, Parameter
from rotemina.drivers.mc68hc11.dialogue import Request, Urgency
from rotemina.drivers.mc68hc11.host_messages import Identify, ReadParameter, WriteParameter
from rotemina.drivers.mc68hc11.parameters import PER_AXIS, fingerprint, meaning, parameters_of
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import VERSION, State
from rotemina.drivers.mc68hc11.wire_guard import StepLimits
from rotemina.drivers.parameters import ParameterDifference
from rotemina.sim.messages import joined, marked, message
from rotemina.sim.robot.model import Robot

PER_BOARD = (
    32  # index of a difference: a board's own number, and so many more for each board before
)


class Trust:
    """The parameters of all boards beside those of a robot."""

    def __init__(self, robot: Robot, boards: Sequence[Board]) -> None:
        self._robot = robot
        self._boards = tuple(boards)
        self._wanted = {board: parameters_of(robot, board.axes) for board in boards}
        self._values: dict[Board, dict[int, int]] = {}
        self._accepted = False
        self._writing = 0  # answers that are still to come
        self.failure: str | None = None

    @property
    def differences(self) -> tuple[ParameterDifference, ...]:
        """What differs, the first board's first."""
        found = []
        for at, board in enumerate(self._boards):
            own = self._values.get(board, {})
            for index, wanted in enumerate(self._wanted[board]):
                if (value := own.get(index, wanted)) != wanted:
                    what = meaning(self._robot, board.axes, index)
                    number = at * PER_BOARD + index
                    found.append(ParameterDifference(number, what.name, what.unit, value, wanted))
        return tuple(found)

    def value(self, board: Board, index: int) -> int:
        """Return a parameter that a board has."""
        return self._values.get(board, {}).get(index, self._wanted[board][index])

    def wanted(self, board: Board, index: int) -> int:
        """Return a parameter as the robot file has it."""
        return self._wanted[board][index]

    def limits(self, board: Board) -> dict[int, StepLimits]:
        """Return the limits of a board's axes by the robot file, by the board's number of each."""
        limits = {}
        for axis in board.axes:
            low, high, speed = self._wanted[board][PER_AXIS * axis.number :][:3]
            limits[axis.number] = StepLimits(axis.name, low, high, max(speed, 1))
        return limits

    def compare(self) -> None:
        """Ask each board whose fingerprint is another one for all its parameters."""
        for board in self._boards:
            assert board.identity is not None, "it was identified"
            if board.identity.fingerprint != fingerprint(self._wanted[board]):
                self._ask(board)

    def accept(self) -> None:
        """Take the boards' own for good."""
        self._accepted = True

    def write(self, permit: Permit) -> None:
        """Begin to write what differs; the boards are read again afterwards."""
        self.failure = None
        for difference in self.differences:
            at, index = divmod(difference.index, PER_BOARD)
            board = self._boards[at]
            message = WriteParameter(index, self._wanted[board][index])
            self._writing += 1
            board.dialogue.ask(
                Request(
                    message=message,
                    urgency=Urgency.BACKGROUND,
                    answered=partial(self._written, board, message),
                    refused=partial(self._refused, board, message),
                    permit=permit,
                )
            )

    def cut_off(self) -> None:
        """Note that a stop has ended what was being written: no answers come any more."""
        if self._writing:
            self._writing = 0
            self.failure = marked("engine", "a stop interrupted the writing")

    def demand(self, name: str, action: str) -> None:
        """Refuse to move while parameters differ and nobody has accepted that.

        Raises
        ------
        StateError
            With what differs, and what to do.
        """
        if self._writing or any(board.state & State.WRITING for board in self._boards):
            raise StateError(
                message(
                    "engine", "{name}: cannot {action} while its parameters are written; wait"
                ).fill(name=name, action=action)
            )
        differences = self.differences
        if self._accepted or not differences:
            return
        told = [str(differences[0])]
        if len(differences) > 1:
            more = message("engine", "and {count} more").fill(count=len(differences) - 1)
            told.append(more)
        if self.failure:
            told.append(self.failure)
        raise StateError(
            message(
                "engine",
                "{name}: cannot {action}: the boards' parameters differ from the robot file "
                "({differences}); accept_parameters or write_parameters first",
            ).fill(name=name, action=action, differences=joined(told, "; "))
        )

    def _ask(self, board: Board) -> None:
        self._values[board] = {}
        for index in range(len(self._wanted[board])):
            board.dialogue.ask(
                Request(
                    message=ReadParameter(index),
                    urgency=Urgency.BACKGROUND,
                    answer=Parameter,
                    matches=partial(_is, index),
                    answered=partial(self._read, board),
                )
            )

    def _read(self, board: Board, told: Message, _now_s: float) -> None:
        assert isinstance(told, Parameter), "it was matched"
        self._values[board][told.index] = told.value

    def _written(self, board: Board, said: WriteParameter, _: Message, _now_s: float) -> None:
        self._writing -= 1
        self._values[board][said.index] = said.value
        if self._writing == 0:
            for one in self._boards:
                one.dialogue.ask(
                    Request(
                        message=Identify(VERSION),
                        urgency=Urgency.BACKGROUND,
                        answer=Identity,
                        answered=partial(self._verified, one),
                    )
                )

    def _verified(self, board: Board, told: Message, _now_s: float) -> None:
        assert isinstance(told, Identity), "it was matched"
        board.identity = told
        if told.fingerprint != fingerprint(self._wanted[board]):
            self.failure = message(
                "engine", "board {address} did not store the written parameters"
            ).fill(address=board.address)
            self._ask(board)

    def _refused(self, board: Board, said: WriteParameter, reason: int | None) -> None:
        self._writing -= 1
        what = meaning(self._robot, board.axes, said.index).name
        self.failure = message(
            "engine", "board {address} refused to set {what} (reason {reason})"
        ).fill(address=board.address, what=what, reason=str(reason))


def _is(index: int, message: Message) -> bool:
    return isinstance(message, Parameter) and message.index == index
