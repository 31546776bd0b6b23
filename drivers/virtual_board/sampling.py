"""The sampling instants of a board, for telemetry and captures."""

from rotemina.drivers.mc68hc11.board_messages import Captured
from rotemina.drivers.mc68hc11.framing import MAX_PAYLOAD
from rotemina.drivers.virtual_board.clock import MASK, BoardClock, signed
from rotemina.drivers.virtual_board.machine import Machine

_SAMPLE = 2  # bytes of one axis
_LOW_BITS = 0xFFFF


class Schedule:
    """Every so often a tick, from a time of the board on."""

    def __init__(self, clock: BoardClock, period_us: int, begin_us: int, now: int) -> None:
        self._clock = clock
        self._period_us = period_us
        behind_us = signed(clock.at_tick(now) - begin_us)
        if behind_us >= 0:  # the first one that is still to come
            begin_us += (behind_us // period_us + 1) * period_us
        self._due_us = begin_us & MASK
        self.tick = clock.tick_at(self._due_us, now)

    def go_on(self, now: int) -> None:
        """Wait for the next one."""
        self._due_us = self._due_us + self._period_us & MASK
        self.tick = self._clock.tick_at(self._due_us, now)


class Capture:
    """Samples of some axes at a rate that telemetry has no room for.

    Parameters
    ----------
    machine : Machine
    indices : tuple of int
        The axes, by their numbers in the machine.
    schedule : Schedule
        When samples are taken; the first one at its present tick.
    samples : int
    """

    def __init__(
        self, machine: Machine, indices: tuple[int, ...], schedule: Schedule, samples: int
    ) -> None:
        self._machine = machine
        self._indices = indices
        self._schedule = schedule
        self._left = samples
        self._frame = (MAX_PAYLOAD - Captured.LAYOUT.size) // (_SAMPLE * len(indices))
        self._sent = 0
        self.begins = schedule.tick
        self._ticks: list[int] = []
        self._plan()

    def _plan(self) -> None:
        """Find the ticks of the next frame."""
        self._ticks = []
        for _ in range(min(self._frame, self._left)):
            self._ticks.append(self._schedule.tick)
            self._schedule.go_on(self._schedule.tick)
        self._left -= len(self._ticks)

    @property
    def due(self) -> int | None:
        """The tick that completes the next frame, None when all is taken."""
        return self._ticks[-1] if self._ticks else None

    def taken(self) -> Captured:
        """Return the frame whose last tick has come; the machine is simulated up to there."""
        readings = self._machine.readings(self._ticks, self._indices)
        packed = b"".join(
            (int(one) & _LOW_BITS).to_bytes(_SAMPLE, "big") for row in readings for one in row
        )
        report = Captured(self._sent & _LOW_BITS, packed)
        self._sent += len(self._ticks)
        self._plan()
        return report
