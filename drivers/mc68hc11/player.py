"""A trajectory on its way to the boards: approach, rest, and set-points ahead of their time."""

from collections.abc import Mapping, Sequence
from enum import Enum, auto
from functools import lru_cache, partial

import numpy as np

from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board import Board, BoardSample
from rotemina.drivers.mc68hc11.orders import constant
from rotemina.drivers.mc68hc11.requests import MoveTo
from rotemina.drivers.mc68hc11.setpoints import Due, SetpointWindow
from rotemina.sim.arrays import IntArray
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.schedule import Schedule

_AHEAD = 14  # set-points that a board has before their time, of the 16 that it can hold
_LEAD = 24  # instants from the decision to begin until the first set-point acts
_CHUNK = 256
_CLIP = 1 << 15  # steps: a deviation that telemetry cannot tell

Steps = tuple[tuple[int, ...], ...]  # of each board


class _Phase(Enum):
    APPROACH = auto()
    SETTLE = auto()
    ROWS = auto()
    OVER = auto()


class Player:
    """One playback.

    Parameters
    ----------
    trajectory : Record
        Inside every limit.
    boards : sequence of Board
    speeds : mapping
        Greatest speed of each axis, steps/s, for the approach.
    ends : mapping
        First and last step of each axis.
    settle_s : float
        How long to rest at the first row.
    permit : Permit
        What all that it sends passes the gate with.
    every : int
        Of how many sampling instants one is that of a set-point.
    """

    def __init__(
        self,
        trajectory: Record,
        boards: Sequence[Board],
        speeds: Mapping[str, int],
        ends: Mapping[str, tuple[int, int]],
        settle_s: float,
        permit: Permit,
        every: int = 1,
    ) -> None:
        self._permit = permit
        self._boards = tuple(boards)
        self._ends = ends
        self._places = [(b, axis) for b, board in enumerate(boards) for axis in board.axes]
        names = tuple(axis.name for _, axis in self._places)
        grid = boards[0].grid
        assert grid is not None, "telemetry is on"
        self._every = every
        self._schedule = Schedule(trajectory, names, 1e-6 * grid.period_us * every, on_ticks=True)
        self._first = {
            index: self._steps_of(index, at) for index, at in self._schedule.first.items()
        }
        self._settle_s = settle_s
        self._phase = _Phase.APPROACH
        self._rested_s = 0.0
        self._begin: int | None = None  # the number of the instant of the first set-point
        self._instant = 0
        self._held: list[int] = []
        self._streaming: tuple[Board, ...] = ()
        self._chunk = lru_cache(maxsize=4)(self._chunk_of)
        self.failure: str | None = None
        for index, target in self._first.items():
            b, axis = self._places[index]
            message = MoveTo(axis.number, target, speeds[axis.name])
            key = ("axis", axis.number)
            self._boards[b].orders.give(key, partial(constant, message), permit=permit)

    @property
    def over(self) -> bool:
        """Whether all of it was played, or it was given up."""
        return self._phase is _Phase.OVER

    @property
    def progress(self) -> float:
        """How much was played, 0 to 1."""
        return self._schedule.progress(self._instant)

    def step(self, now_s: float, settled: int) -> None:
        """Go on; ``settled`` is the number of the latest instant that all boards have told of."""
        if self._phase is _Phase.APPROACH and all(board.at_rest for board in self._boards):
            self._arrive(now_s)
        if self._phase is _Phase.SETTLE and now_s >= self._rested_s + self._settle_s:
            self._begin_rows(now_s)
        if self._phase is _Phase.ROWS:
            self._feed(now_s, settled)

    def give_up(self) -> None:
        """End it where it is; what was sent already is up to the boards."""
        self._phase = _Phase.OVER
        for board in self._streaming:
            board.link.end_stream(board.address)

    def named(self, number: int, row: Sequence[BoardSample]) -> tuple[int, Steps]:
        """Return which row began to act at an instant, or -1, and the commands of each board.

        A row counts only if every board says that it acts on it.
        """
        told = tuple(part.commands for part in row)
        if self._begin is None:
            return -1, told
        instant, between = divmod(number - self._begin, self._every)
        if between or not 0 <= instant < self._schedule.count:
            return -1, told
        steps, numbers = self._chunk(instant // _CHUNK)
        at = instant % _CHUNK
        sent = tuple(tuple(int(one) for one in board[at]) for board in steps)
        for board, part, own in zip(self._boards, row, sent, strict=True):
            if board in self._streaming and not (part.sound and _is_told(part, own)):
                return -1, told
        commands = tuple(
            own if board in self._streaming else part.commands
            for board, part, own in zip(self._boards, row, sent, strict=True)
        )
        return int(numbers[at]), commands

    def _arrive(self, now_s: float) -> None:
        for index, target in self._first.items():
            b, axis = self._places[index]
            board = self._boards[b]
            if board.commanded()[axis.number] != target:
                self.failure = f"axis {axis.name} did not reach the trajectory's first row"
                self.give_up()
                return
        self._phase, self._rested_s = _Phase.SETTLE, now_s

    def _begin_rows(self, now_s: float) -> None:
        self._held = [step for board in self._boards for step in board.commanded()]
        latest = max(board.number_at(now_s) for board in self._boards)
        # Telemetry that is slowed down meanwhile is of these instants.
        self._begin = latest - latest % self._every + _LEAD * self._every
        moved = {self._places[index][0] for index in self._first}
        self._streaming = tuple(self._boards[b] for b in sorted(moved))
        for b in sorted(moved):
            board = self._boards[b]
            window = SetpointWindow(
                board.address,
                self._schedule.count,
                partial(self._due, b),
                board.link.answer_s,
                self._permit,
            )
            board.link.begin_stream(board.address, window)
        self._phase = _Phase.ROWS

    def _feed(self, now_s: float, settled: int) -> None:
        assert self._begin is not None, "the rows have begun"
        for board in self._streaming:
            window = board.link.windows.get(board.address)
            if window is None:
                continue
            window.release(self._instants(board.number_at(now_s)) + _AHEAD)
            if window.refusal is not None:
                self.failure = f"board {board.address} refused a set-point ({window.refusal})"
                self.give_up()
                return
        self._instant = min(max(self._instants(settled), 0), self._schedule.count)
        if self._instant == self._schedule.count:
            self.give_up()

    def _instants(self, number: int) -> int:
        """Return how many set-points have acted at a sampling instant; negative before."""
        assert self._begin is not None, "the rows have begun"
        return (number - self._begin) // self._every + 1

    def _due(self, b: int, instant: int) -> Due:
        grid = self._boards[b].grid
        assert grid is not None, "telemetry is on"
        assert self._begin is not None, "the rows have begun"
        steps, _ = self._chunk(instant // _CHUNK)
        own = tuple(int(one) for one in steps[b][instant % _CHUNK])
        return Due(grid.time_us(self._begin + instant * self._every), own)

    def _chunk_of(self, chunk: int) -> tuple[list[IntArray], IntArray]:
        """Return the steps (n, axes) of each board and the rows (n,), -1 between two rows."""
        instants = self._schedule.instants(chunk * _CHUNK, (chunk + 1) * _CHUNK)
        commands = self._schedule.commands(instants.row, np.zeros(len(self._places)))
        steps = np.tile(np.array(self._held, dtype=np.int64), (len(commands), 1))
        for index in self._first:
            steps[:, index] = [self._steps_of(index, float(at)) for at in commands[:, index]]
        parts, begin = [], 0
        for board in self._boards:
            parts.append(steps[:, begin : begin + len(board.axes)])
            begin += len(board.axes)
        return parts, np.where(instants.on_row, instants.row, -1)

    def _steps_of(self, index: int, value: float) -> int:
        _, axis = self._places[index]
        low, high = self._ends[axis.name]
        return min(max(axis.steps(value), low), high)


def _is_told(part: BoardSample, sent: tuple[int, ...]) -> bool:
    """Whether a board's sample tells these commands, as far as it can."""
    for reading, command, own in zip(part.readings, part.commands, sent, strict=True):
        if command - reading != min(max(own - reading, -_CLIP), _CLIP - 1):
            return False
    return True
