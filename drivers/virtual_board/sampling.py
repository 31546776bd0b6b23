"""Sampling schedules of a board, for telemetry and captures."""

from rotemina.drivers.mc68hc11.protocol import MAX_PAYLOAD_BYTES, CaptureSamples
from rotemina.drivers.virtual_board.clock import TIME_MASK, CrystalClock, wrap_difference
from rotemina.drivers.virtual_board.machine import BoardMachine

_SAMPLE_BYTES = 2
_LOW_16_BITS = 0xFFFF


class SamplingSchedule:
    """Periodic sampling ticks that start at a board time."""

    def __init__(self, clock: CrystalClock, period_us: int, begin_us: int, now: int) -> None:
        self._clock = clock
        self._period_us = period_us
        behind_us = wrap_difference(clock.find_time_us(now) - begin_us)
        if behind_us >= 0:
            # The start time has passed, so start at the next sampling instant.
            begin_us += (behind_us // period_us + 1) * period_us
        self._due_us = begin_us & TIME_MASK
        self.next_tick = clock.find_tick(self._due_us, now)

    def advance(self, now: int) -> None:
        """Advance to the next sampling instant."""
        self._due_us = self._due_us + self._period_us & TIME_MASK
        self.next_tick = self._clock.find_tick(self._due_us, now)


class FirmwareCapture:
    """Capture of some axes at a higher rate than telemetry.

    Parameters
    ----------
    machine : BoardMachine
    indices : tuple of int
        Indices of the axes in the machine.
    schedule : SamplingSchedule
        Ticks at which samples are taken. The first sample is taken at its current tick.
    samples : int
        Number of samples.
    """

    def __init__(
        self,
        machine: BoardMachine,
        indices: tuple[int, ...],
        schedule: SamplingSchedule,
        samples: int,
    ) -> None:
        self._machine = machine
        self._indices = indices
        self._schedule = schedule
        self._remaining_count = samples
        self._samples_per_frame = (MAX_PAYLOAD_BYTES - CaptureSamples.LAYOUT.size) // (
            _SAMPLE_BYTES * len(indices)
        )
        self._sent_count = 0
        self.begin_tick = schedule.next_tick
        self._frame_ticks: list[int] = []
        self._plan_frame()

    def _plan_frame(self) -> None:
        self._frame_ticks = []
        for _ in range(min(self._samples_per_frame, self._remaining_count)):
            self._frame_ticks.append(self._schedule.next_tick)
            self._schedule.advance(self._schedule.next_tick)
        self._remaining_count -= len(self._frame_ticks)

    @property
    def due_tick(self) -> int | None:
        """Tick that completes the next frame, or None if all samples have been taken."""
        return self._frame_ticks[-1] if self._frame_ticks else None

    def take_frame(self) -> CaptureSamples:
        """Return the frame that is due. The machine must be simulated up to its last tick."""
        readings = self._machine.find_readings(self._frame_ticks, self._indices)
        packed = b"".join(
            (int(reading) & _LOW_16_BITS).to_bytes(_SAMPLE_BYTES, "big")
            for row in readings
            for reading in row
        )
        report = CaptureSamples(self._sent_count & _LOW_16_BITS, packed)
        self._sent_count += len(self._frame_ticks)
        self._plan_frame()
        return report
