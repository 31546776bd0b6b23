"""A trajectory on its way to the boards: approach, rest, and segments ahead of their time.

A segment holds two set-points: its two differences lead through both, step by step.

The first set-point acts 0.3 s after the stream began, and 31 segments wait in the board. One is
sent per turn, so that a stop waits for one frame only: at 200 rows per second the queue runs empty
below 100 turns per second. If the host dies, playback ends with the queue or by the watchdog.

Rows are held, because a record cannot say that an axis was interpolated: a stepper jumps by 140
steps at 2.8 mm/s and 5 ms. Straight lines between rows would take a segment for each row.
"""

from collections.abc import Mapping, Sequence
from enum import Enum, auto
from functools import lru_cache, partial
from math import ceil

import numpy as np

from rotemina.drivers.errors import LimitError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.board import Board, BoardSample
from rotemina.drivers.mc68hc11.dialogue import Request
from rotemina.drivers.mc68hc11.host_messages import BeginStream, MoveTo, SetPoint
from rotemina.drivers.mc68hc11.line_budget import ROWS
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import QUEUE
from rotemina.drivers.mc68hc11.segment_window import MOST_WAY, ROUNDING, UNDER_WAY, SetpointWindow
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.schedule import Schedule

_AHEAD = QUEUE - 1  # segments that wait in a board: its clock may be one behind ours
# From the decision to begin until the first set-point acts, at least: a computer that is busy just
# then is not late either.
_LEAD, _LEAD_S = 24, 0.3  # set-points, and time
_CHUNK = 256
_CHECKED = 1 << 16  # set-points looked at in one go
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
        Greatest speed of each axis, steps/s.
    ends : mapping
        First and last step of each axis.
    settle_s : float
        How long to rest at the first row.
    permit : Permit
        What all that it sends passes the gate with.
    every : int
        Of how many sampling instants one is that of a set-point.

    Raises
    ------
    LimitError
        If a board would refuse a set-point, or the line is too slow for them; nothing was asked of
        any board then.
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
        period_s = 1e-6 * grid.period_us * every
        self._lead = max(_LEAD, ceil(_LEAD_S / period_s))
        self._schedule = Schedule(trajectory, names, period_s, on_ticks=True)
        self._first = {
            index: int(self._steps_of(index, np.array(at)))
            for index, at in self._schedule.first.items()
        }
        self._check(trajectory, speeds, period_s)
        self._check_round_trips(period_s)
        self._settle_s = settle_s
        self._phase = _Phase.APPROACH
        self._rested_s = 0.0
        self._begin: int | None = None  # the number of the instant of the first set-point
        self._instant = 0
        self._stand: Steps = ()
        self._streaming: tuple[Board, ...] = ()
        self._chunk = lru_cache(maxsize=4)(self._chunk_of)
        self.failure: str | None = None
        for index, target in self._first.items():
            b, axis = self._places[index]
            message = MoveTo(axis.number, target, speeds[axis.name])
            key = ("axis", axis.number)
            self._boards[b].orders.give(key, message, permit=permit)

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
                self.failure = message(
                    "engine", "axis {name} did not reach the trajectory's first row"
                ).fill(name=axis.name)
                self.give_up()
                return
        self._phase, self._rested_s = _Phase.SETTLE, now_s

    def _begin_rows(self, now_s: float) -> None:
        self._stand = tuple(tuple(board.commanded()) for board in self._boards)
        latest = max(board.number_at(now_s) for board in self._boards)
        # Telemetry that is slowed down meanwhile is of these instants.
        self._begin = latest - latest % self._every + self._lead * self._every
        moved = {self._places[index][0] for index in self._first}
        self._streaming = tuple(self._boards[b] for b in sorted(moved))
        for b in sorted(moved):
            board = self._boards[b]
            grid = board.grid
            assert grid is not None, "telemetry is on"
            begin_us = grid.time_us(self._begin) % (1 << 32)
            board.dialogue.ask(
                Request(
                    message=BeginStream(begin_us, self._segments, self._hold(board), fraction=0),
                    answered=partial(self._begun, b),
                    refused=partial(self._refused, board),
                    permit=self._permit,
                )
            )
        self._phase = _Phase.ROWS

    @property
    def _segments(self) -> int:
        return -(-self._schedule.count // ROWS)

    def _hold(self, board: Board) -> int:
        """Return how many ticks of a board a set-point lasts."""
        assert board.rates is not None, "it announced them when it was opened"
        assert board.grid is not None, "telemetry is on"
        return board.grid.period_us * self._every * board.rates.tick // 1_000_000

    def _begun(self, b: int, _answer: Message, _now_s: float) -> None:
        """Let segments go out to a board that has begun its stream."""
        board = self._boards[b]
        if self._phase is _Phase.ROWS:
            window = SetpointWindow(
                board.address, self._segments, partial(self._segment, b), board.told_s, self._permit
            )
            board.link.begin_stream(board.address, window)

    def _refused(self, board: Board, reason: int | None) -> None:
        if reason is not None:  # else a stop came before it
            self.failure = message(
                "engine", "board {address} refused to begin the trajectory ({reason})"
            ).fill(address=board.address, reason=reason)
        self.give_up()

    def _feed(self, now_s: float, settled: int) -> None:
        assert self._begin is not None, "the rows have begun"
        for board in self._streaming:
            window = board.link.windows.get(board.address)
            if window is None:
                continue
            begun = -(-self._instants(board.number_at(now_s)) // ROWS)
            window.release(begun + _AHEAD)
            if window.refusal is not None:
                self.failure = message(
                    "engine", "board {address} refused a set-point ({refusal})"
                ).fill(address=board.address, refusal=window.refusal)
                self.give_up()
                return
        self._instant = min(max(self._instants(settled), 0), self._schedule.count)
        if self._instant == self._schedule.count:
            self.give_up()

    def _instants(self, number: int) -> int:
        """Return how many set-points have acted at a sampling instant; negative before."""
        assert self._begin is not None, "the rows have begun"
        return (number - self._begin) // self._every + 1

    def _segment(self, b: int, place: int) -> SetPoint:
        """Return a segment that leads from the set-point before it through its own."""
        first = place * ROWS
        own = [
            self._at(b, one) for one in range(first - 1, min(first + ROWS, self._schedule.count))
        ]
        differences = []
        for before, *rows in zip(*own, strict=True):
            to = rows[0] - before
            second = rows[1] - rows[0] - to if len(rows) == ROWS else 0
            differences.append((to - second, second))
        hold = self._hold(self._boards[b])
        return SetPoint.of(place % 256, hold * (len(own) - 1), differences)

    def _at(self, b: int, instant: int) -> tuple[int, ...]:
        """Return the steps of a board at an instant; before the first one where it stands."""
        if instant < 0:
            return self._stand[b]
        steps, _ = self._chunk(instant // _CHUNK)
        return tuple(int(one) for one in steps[b][instant % _CHUNK])

    def _chunk_of(self, chunk: int) -> tuple[list[IntArray], IntArray]:
        """Return the steps (n, axes) of each board and the rows (n,), -1 between two rows."""
        instants = self._schedule.instants(chunk * _CHUNK, (chunk + 1) * _CHUNK)
        commands = self._schedule.commands(instants.row, np.zeros(len(self._places)))
        stand = [step for own in self._stand for step in own]
        steps = np.tile(np.array(stand, dtype=np.int64), (len(commands), 1))
        for index in self._first:
            steps[:, index] = self._steps_of(index, commands[:, index])
        parts, begin = [], 0
        for board in self._boards:
            parts.append(steps[:, begin : begin + len(board.axes)])
            begin += len(board.axes)
        return parts, np.where(instants.on_row, instants.row, -1)

    def _steps_of(self, index: int, values: FloatArray) -> IntArray:
        """Return positions (n,) of an axis in whole steps, inside its ends."""
        _, axis = self._places[index]
        steps = np.rint(values / axis.step).astype(np.int64)
        return np.asarray(np.clip(steps, *self._ends[axis.name]))

    def _check(self, trajectory: Record, speeds: Mapping[str, int], period_s: float) -> None:
        """Refuse a trajectory whose set-points lie farther apart than a board lets them."""
        count, none = self._schedule.count, np.zeros(len(self._places))
        for begin in range(0, count - 1, _CHECKED):
            instants = self._schedule.instants(begin, begin + _CHECKED + 1)
            commands = self._schedule.commands(instants.row, none)
            for index in self._first:
                _, axis = self._places[index]
                ways = np.abs(np.diff(self._steps_of(index, commands[:, index])))
                at = int(np.argmax(ways))
                most = min(speeds[axis.name] * period_s + ROUNDING, MOST_WAY)
                if ways[at] > most:
                    way, bound = axis.step * float(ways[at]), axis.step * most
                    unit = trajectory.units[axis.name]
                    raise LimitError(
                        message(
                            "engine",
                            "axis {axis}: the set-points around t = {time} s lie {value} apart, "
                            "beyond the limit {bound} in {period}; give a row every {period}, or "
                            "stretch the trajectory's time by a factor of {factor} or more",
                        ).fill(
                            axis=AxisName(axis.name),
                            time=rounded(trajectory.time_s[0] + instants.time_s[at + 1], 6),
                            value=exact(way, unit, size=bound),
                            bound=exact(bound, unit),
                            period=exact(period_s, "s"),
                            factor=rounded(way / bound, 3),
                        )
                    )

    def _check_round_trips(self, period_s: float) -> None:
        """Refuse to play over a line on which set-points would come too late."""
        moved = [self._boards[b] for b in sorted({self._places[i][0] for i in self._first})]
        for board in moved:
            if board.link.half_duplex:
                # Each segment waits for its answer; polls and the boards of the line take turns.
                turns = 1 + sum(one.link is board.link for one in moved)
                limit_s = ROWS * period_s / turns
            else:
                limit_s = UNDER_WAY * ROWS * period_s - 2e-3 * board.telemetry_ms
            if board.round_trip_s > limit_s:
                raise LimitError(
                    message(
                        "engine",
                        "{where} answers after {trip}: for a set-point every {period} it must not "
                        "take longer than {limit}; use a faster connection to play trajectories",
                    ).fill(
                        where=board.where,
                        trip=exact(board.round_trip_s, "s"),
                        period=exact(period_s, "s"),
                        limit=exact(limit_s, "s"),
                    )
                )


def _is_told(part: BoardSample, sent: tuple[int, ...]) -> bool:
    """Whether a board's sample tells these commands, as far as it can."""
    for reading, command, own in zip(part.readings, part.commands, sent, strict=True):
        if command - reading != min(max(own - reading, -_CLIP), _CLIP - 1):
            return False
    return True
