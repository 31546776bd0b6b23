"""Comparison of the boards' parameters with the robot file; writes or accepts differences."""

from collections.abc import Sequence
from functools import partial

from rotemina.drivers.abilities import ParameterDifference
from rotemina.drivers.contract import Permit, StateError
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.dialogue import BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.protocol import (
    PARAMETERS_PER_AXIS,
    PROTOCOL_VERSION,
    BoardIdentity,
    BoardState,
    IdentifyBoard,
    ParameterValue,
    ReadParameter,
    WireMessage,
    WriteParameter,
    compute_fingerprint,
    describe_parameter,
    make_parameters,
)
from rotemina.drivers.mc68hc11.wire_guard import StepLimits
from rotemina.sim.messages import (
    join_messages,
    marked,
    message,
)
from rotemina.sim.robot import Robot

# The index of a difference is the index in its board, plus this number for each earlier board.
INDICES_PER_BOARD = 32


class ParameterCheck:
    """Comparison of the parameters of all boards with those of a robot.

    Parameters
    ----------
    robot : Robot
    boards : sequence of Board

    Attributes
    ----------
    failure : str or None
        Reason why the latest attempt to write parameters failed.
    """

    def __init__(self, robot: Robot, boards: Sequence[Board]) -> None:
        self._robot = robot
        self._boards = tuple(boards)
        self._robot_values = {board: make_parameters(robot, board.axes) for board in boards}
        self._board_values: dict[Board, dict[int, int]] = {}
        self._are_differences_accepted = False
        # Number of writes that have not been answered yet.
        self._pending_writes = 0
        self.failure: str | None = None

    @property
    def differences(self) -> tuple[ParameterDifference, ...]:
        """Differences from the robot file, those of the first board first."""
        differences = []
        for board_index, board in enumerate(self._boards):
            values = self._board_values.get(board, {})
            for index, robot_value in enumerate(self._robot_values[board]):
                if (value := values.get(index, robot_value)) != robot_value:
                    parameter = describe_parameter(self._robot, board.axes, index)
                    number = board_index * INDICES_PER_BOARD + index
                    differences.append(
                        ParameterDifference(
                            number, parameter.name, parameter.unit, value, robot_value
                        )
                    )
        return tuple(differences)

    def get_board_value(self, board: Board, index: int) -> int:
        """Return the value of a parameter in a board."""
        return self._board_values.get(board, {}).get(index, self._robot_values[board][index])

    def get_robot_value(self, board: Board, index: int) -> int:
        """Return the value of a parameter according to the robot file."""
        return self._robot_values[board][index]

    def make_step_limits(self, board: Board) -> dict[int, StepLimits]:
        """Return the limits of a board's axes, by axis number, according to the robot file."""
        limits = {}
        for axis in board.axes:
            low, high, speed = self._robot_values[board][PARAMETERS_PER_AXIS * axis.number :][:3]
            limits[axis.number] = StepLimits(axis.name, low, high, max(speed, 1))
        return limits

    def compare_fingerprints(self) -> None:
        """Request all parameters of each board whose fingerprint differs from the robot file."""
        for board in self._boards:
            assert board.identity is not None, "the board has been identified"
            if board.identity.fingerprint != compute_fingerprint(self._robot_values[board]):
                self._read_parameters(board)

    def accept_differences(self) -> None:
        """Accept the differences of the boards' parameters until the connection is closed."""
        self._are_differences_accepted = True

    def write_differences(self, permit: Permit) -> None:
        """Start to write the parameters that differ. Then the fingerprints are compared again."""
        self.failure = None
        for difference in self.differences:
            board_index, index = divmod(difference.index, INDICES_PER_BOARD)
            board = self._boards[board_index]
            message = WriteParameter(index, self._robot_values[board][index])
            self._pending_writes += 1
            board.dialogue.ask(
                BoardRequest(
                    message=message,
                    urgency=RequestUrgency.BACKGROUND,
                    on_answer=partial(self._note_written_value, board, message),
                    on_refusal=partial(self._note_refusal, board, message),
                    permit=permit,
                )
            )

    def note_stop(self) -> None:
        """Record that a stop has interrupted the writing, so that no more answers will arrive."""
        if self._pending_writes:
            self._pending_writes = 0
            self.failure = marked("engine", "a stop interrupted the writing")

    def require_agreement(self, name: str, action: str) -> None:
        """Refuse an action while parameters are written or have differences that are not accepted.

        Raises
        ------
        StateError
            If parameters are written, or differ. The message states a difference and what to do.
        """
        if self._pending_writes or any(board.state & BoardState.WRITING for board in self._boards):
            raise StateError(
                "{name}: cannot {action} while its parameters are written; wait",
                name=name,
                action=action,
            )
        differences = self.differences
        if self._are_differences_accepted or not differences:
            return
        descriptions = [str(differences[0])]
        if len(differences) > 1:
            remainder = message("engine", "and {count} more").fill(count=len(differences) - 1)
            descriptions.append(remainder)
        if self.failure:
            descriptions.append(self.failure)
        raise StateError(
            "{name}: cannot {action}: the boards' parameters differ from the robot file "
            "({differences}); accept_parameters or write_parameters first",
            name=name,
            action=action,
            differences=join_messages(descriptions, "; "),
        )

    def _read_parameters(self, board: Board) -> None:
        self._board_values[board] = {}
        for index in range(len(self._robot_values[board])):
            board.dialogue.ask(
                BoardRequest(
                    message=ReadParameter(index),
                    urgency=RequestUrgency.BACKGROUND,
                    answer_type=ParameterValue,
                    is_answer=partial(_is_value_of, index),
                    on_answer=partial(self._note_value, board),
                )
            )

    def _note_value(self, board: Board, answer: WireMessage, _now_s: float) -> None:
        assert isinstance(answer, ParameterValue), "the request accepts only this type"
        self._board_values[board][answer.index] = answer.value

    def _note_written_value(
        self, board: Board, request: WriteParameter, _: WireMessage, _now_s: float
    ) -> None:
        self._board_values[board][request.index] = request.value
        self._end_write()

    def _end_write(self) -> None:
        """Count an answered or refused write. After the last one, request the fingerprints."""
        self._pending_writes -= 1
        if self._pending_writes:
            return
        for board in self._boards:
            board.dialogue.ask(
                BoardRequest(
                    message=IdentifyBoard(PROTOCOL_VERSION),
                    urgency=RequestUrgency.BACKGROUND,
                    answer_type=BoardIdentity,
                    on_answer=partial(self._verify_fingerprint, board),
                )
            )

    def _verify_fingerprint(self, board: Board, identity: WireMessage, _now_s: float) -> None:
        assert isinstance(identity, BoardIdentity), "the request accepts only this type"
        board.identity = identity
        # A refused parameter still has its previous value.
        values = [
            self.get_board_value(board, index) for index in range(len(self._robot_values[board]))
        ]
        if identity.fingerprint != compute_fingerprint(values):
            self.failure = message(
                "engine", "board {address} did not store the written parameters"
            ).fill(address=board.address)
            self._read_parameters(board)

    def _note_refusal(self, board: Board, request: WriteParameter, reason: int | None) -> None:
        name = describe_parameter(self._robot, board.axes, request.index).name
        self.failure = message(
            "engine", "board {address} refused to set {what} (reason {reason})"
        ).fill(address=board.address, what=name, reason=str(reason))
        self._end_write()


def _is_value_of(index: int, message: WireMessage) -> bool:
    return isinstance(message, ParameterValue) and message.index == index
