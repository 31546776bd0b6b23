"""Playback of a trajectory by the boards: approach, rest, and segments sent ahead of their time.

A segment holds two set-points. Its first and second differences reproduce both exactly.

The first set-point takes effect 0.3 s after the stream was begun. Up to 31 segments wait in the
board. Each service call of the driver sends one segment, so that a stop waits for only one frame.
At 200 rows per second the queue runs empty if there are fewer than 100 calls per second. If the
host crashes, playback ends when the queue is empty or the watchdog expires.

The command of a row is held until the next row, because a record cannot express interpolation. So a
stepper at 2.8 mm/s jumps by 140 steps every 5 ms. Straight lines between rows would need a segment
for each row.
"""

from collections.abc import Mapping, Sequence
from enum import Enum, auto
from functools import lru_cache, partial
from math import ceil

import numpy as np

from rotemina.drivers.contract import LimitError, Permit
from rotemina.drivers.mc68hc11.board import Board, BoardSample
from rotemina.drivers.mc68hc11.dialogue import BoardRequest
from rotemina.drivers.mc68hc11.line_budget import ROWS_PER_SEGMENT
from rotemina.drivers.mc68hc11.protocol import (
    QUEUE_SEGMENTS,
    BeginStream,
    MoveTo,
    StreamSegment,
    WireMessage,
)
from rotemina.drivers.mc68hc11.segment_window import (
    MAX_SETPOINT_DISTANCE_STEPS,
    MAX_UNACKNOWLEDGED_SEGMENTS,
    ROUNDING_STEPS,
    SegmentWindow,
)
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import AxisName, format_rounded, message
from rotemina.sim.records import Record
from rotemina.sim.trajectory import PlaybackSchedule
from rotemina.sim.units import format_exact

# One place in the queue stays free, because the board may be one segment behind the estimate.
_SEGMENTS_AHEAD = QUEUE_SEGMENTS - 1
# Minimum delay from the decision to begin until the first set-point takes effect. It allows for a
# computer that is busy at the start.
_MIN_LEAD_SETPOINTS, _MIN_LEAD_S = 24, 0.3
_CHUNK_INSTANTS = 256
# Long trajectories are checked in blocks, to limit the memory.
_CHECK_BLOCK_SETPOINTS = 1 << 16
# Telemetry clips deviations beyond this limit.
_DEVIATION_LIMIT_STEPS = 1 << 15

# Positions of the axes of each board, steps.
BoardSteps = tuple[tuple[int, ...], ...]


class _Phase(Enum):
    APPROACH = auto()
    SETTLE = auto()
    ROWS = auto()
    OVER = auto()


class SegmentPlayer:
    """Playback of one trajectory.

    Parameters
    ----------
    trajectory : Record
        Trajectory inside all limits.
    boards : sequence of Board
    speeds : mapping
        Maximum speed of each axis, steps/s.
    ends : mapping
        Lowest and highest step of each axis.
    settle_s : float
        Time of rest at the first row.
    permit : Permit
        Permit with which all frames of the playback pass the gate.
    samples_per_setpoint : int
        Number of sampling instants for each set-point.

    Raises
    ------
    LimitError
        If a board would refuse a set-point, or the line is too slow. Then nothing has been sent.
    """

    def __init__(
        self,
        trajectory: Record,
        boards: Sequence[Board],
        speeds: Mapping[str, int],
        ends: Mapping[str, tuple[int, int]],
        settle_s: float,
        permit: Permit,
        samples_per_setpoint: int = 1,
    ) -> None:
        self._permit = permit
        self._boards = tuple(boards)
        self._ends = ends
        # Index of the board, and axis on that board, of each axis of the robot.
        self._board_axes = [
            (board_index, axis) for board_index, board in enumerate(boards) for axis in board.axes
        ]
        names = tuple(axis.name for _, axis in self._board_axes)
        grid = boards[0].grid
        assert grid is not None, "telemetry must be on"
        self._samples_per_setpoint = samples_per_setpoint
        period_s = 1e-6 * grid.period_us * samples_per_setpoint
        self._lead_setpoints = max(_MIN_LEAD_SETPOINTS, ceil(_MIN_LEAD_S / period_s))
        self._schedule = PlaybackSchedule(trajectory, names, period_s, on_ticks=True)
        self._first_steps = {
            index: int(self._to_steps(index, np.array(position)))
            for index, position in self._schedule.first_commands.items()
        }
        self._check_distances(trajectory, speeds, period_s)
        self._check_round_trips(period_s)
        self._settle_s = settle_s
        self._phase = _Phase.APPROACH
        self._rest_start_s = 0.0
        # Number of the sampling instant at which the first set-point takes effect.
        self._begin_number: int | None = None
        self._played_count = 0
        self._start_steps: BoardSteps = ()
        self._streaming_boards: tuple[Board, ...] = ()
        self._get_chunk = lru_cache(maxsize=4)(self._compute_chunk)
        self.failure: str | None = None
        for index, target in self._first_steps.items():
            board_index, axis = self._board_axes[index]
            message = MoveTo(axis.number, target, speeds[axis.name])
            key = ("axis", axis.number)
            self._boards[board_index].orders.queue_order(key, message, permit=permit)

    @property
    def is_over(self) -> bool:
        """Whether all rows were played, or the playback was aborted."""
        return self._phase is _Phase.OVER

    @property
    def progress(self) -> float:
        """Fraction of the trajectory that was played, 0 to 1."""
        return self._schedule.progress(self._played_count)

    def advance(self, now_s: float, latest_finished_number: int) -> None:
        """Continue the playback.

        Parameters
        ----------
        now_s : float
            Host time, s.
        latest_finished_number : int
            Number of the latest sampling instant that all boards have reported.
        """
        if self._phase is _Phase.APPROACH and all(board.at_rest for board in self._boards):
            self._check_arrival(now_s)
        if self._phase is _Phase.SETTLE and now_s >= self._rest_start_s + self._settle_s:
            self._begin_rows(now_s)
        if self._phase is _Phase.ROWS:
            self._release_segments(now_s, latest_finished_number)

    def abort(self) -> None:
        """End the playback. The boards still execute the segments that they have received."""
        self._phase = _Phase.OVER
        for board in self._streaming_boards:
            board.link.end_stream(board.address)

    def find_row(self, number: int, row: Sequence[BoardSample]) -> tuple[int, BoardSteps]:
        """Return the row that took effect at an instant, and the commands of each board, steps.

        The row is -1 if no row took effect, or if the telemetry of a board does not show its
        commands.
        """
        reported_commands = tuple(sample.commands for sample in row)
        if self._begin_number is None:
            return -1, reported_commands
        instant, offset = divmod(number - self._begin_number, self._samples_per_setpoint)
        if offset or not 0 <= instant < self._schedule.count:
            return -1, reported_commands
        steps, row_numbers = self._get_chunk(instant // _CHUNK_INSTANTS)
        index = instant % _CHUNK_INSTANTS
        sent_commands = tuple(
            tuple(int(step) for step in board_steps[index]) for board_steps in steps
        )
        for board, sample, sent_steps in zip(self._boards, row, sent_commands, strict=True):
            if board in self._streaming_boards and not (
                sample.fault_free and _has_reported(sample, sent_steps)
            ):
                return -1, reported_commands
        commands = tuple(
            sent_steps if board in self._streaming_boards else sample.commands
            for board, sample, sent_steps in zip(self._boards, row, sent_commands, strict=True)
        )
        return int(row_numbers[index]), commands

    def _check_arrival(self, now_s: float) -> None:
        for index, target in self._first_steps.items():
            board_index, axis = self._board_axes[index]
            board = self._boards[board_index]
            if board.read_commands()[axis.number] != target:
                self.failure = message(
                    "engine", "axis {name} did not reach the trajectory's first row"
                ).fill(name=axis.name)
                self.abort()
                return
        self._phase, self._rest_start_s = _Phase.SETTLE, now_s

    def _begin_rows(self, now_s: float) -> None:
        self._start_steps = tuple(tuple(board.read_commands()) for board in self._boards)
        latest_number = max(board.find_sample_number(now_s) for board in self._boards)
        # The first set-point must take effect at an instant of telemetry with a reduced rate.
        self._begin_number = (
            latest_number
            - latest_number % self._samples_per_setpoint
            + self._lead_setpoints * self._samples_per_setpoint
        )
        moving_board_indices = {self._board_axes[index][0] for index in self._first_steps}
        self._streaming_boards = tuple(
            self._boards[board_index] for board_index in sorted(moving_board_indices)
        )
        for board_index in sorted(moving_board_indices):
            board = self._boards[board_index]
            grid = board.grid
            assert grid is not None, "telemetry must be on"
            begin_us = grid.find_time_us(self._begin_number) % (1 << 32)
            board.dialogue.ask(
                BoardRequest(
                    message=BeginStream(
                        begin_us, self._segment_count, self._compute_hold_ticks(board), fraction=0
                    ),
                    on_answer=partial(self._start_window, board_index),
                    on_refusal=partial(self._note_refusal, board),
                    permit=self._permit,
                )
            )
        self._phase = _Phase.ROWS

    @property
    def _segment_count(self) -> int:
        return -(-self._schedule.count // ROWS_PER_SEGMENT)

    def _compute_hold_ticks(self, board: Board) -> int:
        assert board.rates is not None, "the board reported its rates when it was opened"
        assert board.grid is not None, "telemetry must be on"
        return board.grid.period_us * self._samples_per_setpoint * board.rates.tick // 1_000_000

    def _start_window(self, board_index: int, _answer: WireMessage, _now_s: float) -> None:
        board = self._boards[board_index]
        if self._phase is _Phase.ROWS:
            window = SegmentWindow(
                board.address,
                self._segment_count,
                partial(self._make_segment, board_index),
                board.compute_report_delay_s,
                self._permit,
            )
            board.link.begin_stream(board.address, window)

    def _note_refusal(self, board: Board, reason: int | None) -> None:
        # Without a reason, the board has not refused: a stop was sent before it answered.
        if reason is not None:
            self.failure = message(
                "engine", "board {address} refused to begin the trajectory ({reason})"
            ).fill(address=board.address, reason=reason)
        self.abort()

    def _release_segments(self, now_s: float, latest_finished_number: int) -> None:
        assert self._begin_number is not None, "the rows have begun"
        for board in self._streaming_boards:
            window = board.link.windows.get(board.address)
            if window is None:
                continue
            begun_segments = -(
                -self._count_setpoints(board.find_sample_number(now_s)) // ROWS_PER_SEGMENT
            )
            window.release(begun_segments + _SEGMENTS_AHEAD)
            if window.refusal is not None:
                self.failure = message(
                    "engine", "board {address} refused a set-point ({refusal})"
                ).fill(address=board.address, refusal=window.refusal)
                self.abort()
                return
        self._played_count = min(
            max(self._count_setpoints(latest_finished_number), 0), self._schedule.count
        )
        if self._played_count == self._schedule.count:
            self.abort()

    def _count_setpoints(self, number: int) -> int:
        """Return how many set-points have taken effect at an instant; ≤ 0 before the first one."""
        assert self._begin_number is not None, "the rows have begun"
        return (number - self._begin_number) // self._samples_per_setpoint + 1

    def _make_segment(self, board_index: int, index: int) -> StreamSegment:
        first_instant = index * ROWS_PER_SEGMENT
        positions = [
            self._find_steps(board_index, instant)
            for instant in range(
                first_instant - 1, min(first_instant + ROWS_PER_SEGMENT, self._schedule.count)
            )
        ]
        differences = []
        for previous, *rows in zip(*positions, strict=True):
            distance = rows[0] - previous
            second_difference = rows[1] - rows[0] - distance if len(rows) == ROWS_PER_SEGMENT else 0
            differences.append((distance - second_difference, second_difference))
        hold_ticks = self._compute_hold_ticks(self._boards[board_index])
        return StreamSegment.from_differences(
            index % 256, hold_ticks * (len(positions) - 1), differences
        )

    def _find_steps(self, board_index: int, instant: int) -> tuple[int, ...]:
        """Return the commands of a board, steps, at an instant; at the start if it is negative."""
        if instant < 0:
            return self._start_steps[board_index]
        steps, _ = self._get_chunk(instant // _CHUNK_INSTANTS)
        return tuple(int(step) for step in steps[board_index][instant % _CHUNK_INSTANTS])

    def _compute_chunk(self, chunk: int) -> tuple[list[IntArray], IntArray]:
        """Return the commands (n, axes) of each board, steps, and row numbers (n,), or -1.

        The row number is -1 at instants between two rows.
        """
        instants = self._schedule.instants(chunk * _CHUNK_INSTANTS, (chunk + 1) * _CHUNK_INSTANTS)
        commands = self._schedule.commands(instants.row, np.zeros(len(self._board_axes)))
        start_steps = [step for board_steps in self._start_steps for step in board_steps]
        steps = np.tile(np.array(start_steps, dtype=np.int64), (len(commands), 1))
        for index in self._first_steps:
            steps[:, index] = self._to_steps(index, commands[:, index])
        steps_by_board, first_axis = [], 0
        for board in self._boards:
            steps_by_board.append(steps[:, first_axis : first_axis + len(board.axes)])
            first_axis += len(board.axes)
        return steps_by_board, np.where(instants.on_row, instants.row, -1)

    def _to_steps(self, index: int, values: FloatArray) -> IntArray:
        """Return positions (n,) of an axis in whole steps, clipped to its ends."""
        _, axis = self._board_axes[index]
        steps = np.rint(values / axis.step_size).astype(np.int64)
        return np.asarray(np.clip(steps, *self._ends[axis.name]))

    def _check_distances(
        self, trajectory: Record, speeds: Mapping[str, int], period_s: float
    ) -> None:
        """Refuse a trajectory whose set-points are farther apart than a board allows."""
        count, zeros = self._schedule.count, np.zeros(len(self._board_axes))
        for begin in range(0, count - 1, _CHECK_BLOCK_SETPOINTS):
            instants = self._schedule.instants(begin, begin + _CHECK_BLOCK_SETPOINTS + 1)
            commands = self._schedule.commands(instants.row, zeros)
            for index in self._first_steps:
                _, axis = self._board_axes[index]
                distances = np.abs(np.diff(self._to_steps(index, commands[:, index])))
                worst = int(np.argmax(distances))
                max_steps = min(
                    speeds[axis.name] * period_s + ROUNDING_STEPS, MAX_SETPOINT_DISTANCE_STEPS
                )
                if distances[worst] > max_steps:
                    worst_distance, max_distance = (
                        axis.step_size * float(distances[worst]),
                        axis.step_size * max_steps,
                    )
                    unit = trajectory.units[axis.name]
                    raise LimitError(
                        "axis {axis}: the set-points around t = {time} s are {value} apart, "
                        "more than the limit {bound} in {period}; add a row every {period}, or"
                        " stretch the trajectory's time by a factor of {factor} or more",
                        axis=AxisName(axis.name),
                        time=format_rounded(trajectory.time_s[0] + instants.time_s[worst + 1], 6),
                        value=format_exact(worst_distance, unit, size=max_distance),
                        bound=format_exact(max_distance, unit),
                        period=format_exact(period_s, "s"),
                        factor=format_rounded(worst_distance / max_distance, 3),
                    )

    def _check_round_trips(self, period_s: float) -> None:
        """Refuse a line on which set-points would arrive too late."""
        moving_boards = [
            self._boards[number]
            for number in sorted({self._board_axes[index][0] for index in self._first_steps})
        ]
        for board in moving_boards:
            if board.link.half_duplex:
                # Each segment waits for its answer. One poll and one segment for each board on the
                # line take turns.
                turn_count = 1 + sum(other.link is board.link for other in moving_boards)
                limit_s = ROWS_PER_SEGMENT * period_s / turn_count
            else:
                limit_s = (
                    MAX_UNACKNOWLEDGED_SEGMENTS * ROWS_PER_SEGMENT * period_s
                    - 2e-3 * board.telemetry_period_ms
                )
            if board.round_trip_s > limit_s:
                raise LimitError(
                    "{where} takes {trip} to answer, but a set-point every {period} needs an "
                    "answer within {limit}; use a faster connection to play trajectories",
                    where=board.where,
                    trip=format_exact(board.round_trip_s, "s"),
                    period=format_exact(period_s, "s"),
                    limit=format_exact(limit_s, "s"),
                )


def _has_reported(sample: BoardSample, sent_commands: tuple[int, ...]) -> bool:
    """Return whether a sample reports the sent commands, steps, with clipped deviations."""
    for reading, command, sent_command in zip(
        sample.readings, sample.commands, sent_commands, strict=True
    ):
        if command - reading != min(
            max(sent_command - reading, -_DEVIATION_LIMIT_STEPS), _DEVIATION_LIMIT_STEPS - 1
        ):
            return False
    return True
