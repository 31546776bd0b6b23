"""Processor load in several cases: ``python -m rotemina.drivers.mc68hc11.firmware.chip_load``.

The module assembles the time-critical code paths and counts their cycles. A case states how often
each path is executed per second. The polling of the main loop, commands and homing are not counted.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.resources import as_file, files
from typing import NamedTuple

from rotemina.drivers.contract import BudgetError
from rotemina.drivers.mc68hc11.firmware.cycles import (
    INTERRUPT_ENTRY_CYCLES,
    Routines,
    assemble_sources,
    count_cycles,
    count_masked_cycles,
)

SOURCES = ("serial", "motion", "telemetry")
CLOCKS_HZ = (2_000_000, 4_000_000)
BAUD = 125_000
MAX_MASKED_CYCLES = 90
# Cycles of JSR. The cycles of RTS are counted with the routine.
_CALL_CYCLES = 6


@dataclass(frozen=True, slots=True)
class CodePath:
    """Path through the firmware, given by the labels of the routines on it."""

    labels: tuple[str, ...]
    interrupt: bool = False

    def count_cycles(self, routines: Routines) -> int:
        """Return the cycles of the path, including the interrupt entry or the call."""
        instructions = [
            instruction for label in self.labels for instruction in _find_routine(routines, label)
        ]
        return count_cycles(instructions) + (
            INTERRUPT_ENTRY_CYCLES if self.interrupt else _CALL_CYCLES
        )

    def count_masked_cycles(self, routines: Routines) -> int:
        """Return the cycles for which the path blocks interrupts; 0 if it is not an interrupt."""
        instructions = [
            instruction for label in self.labels for instruction in _find_routine(routines, label)
        ]
        return count_masked_cycles(instructions) if self.interrupt else 0


def _find_routine(routines: Routines, label: str) -> list[tuple[int, ...]]:
    if label not in routines:
        raise BudgetError(f"the firmware has no label {label!r}")
    return routines[label]


PATHS = {
    "byte received": CodePath(("isr_serial", "isr_receive"), interrupt=True),
    "byte sent": CodePath(("isr_serial", "isr_send"), interrupt=True),
    "byte decoded": CodePath(("take_byte", "take_plain")),
    "zero decoded": CodePath(("take_byte", "take_stretch")),
    "byte encoded": CodePath(("put_byte", "put_plain")),
    "zero encoded": CodePath(("put_byte", "put_stretch")),
    "tick, row held": CodePath(("isr_held", "held"), interrupt=True),
    "tick, new row, micro": CodePath(("isr_held", "row_axes", "micro_row"), interrupt=True),
    "tick, new row, nano": CodePath(("isr_held", "row_axes", "nano_out"), interrupt=True),
    "tick, interpolated, micro": CodePath(("isr_tick", "step_axes", "micro_out"), interrupt=True),
    "tick, interpolated, nano": CodePath(("isr_tick", "step_axes", "nano_out"), interrupt=True),
    "step edge": CodePath(("isr_edge",), interrupt=True),
    "segment queued": CodePath(("take_segment",)),
    "new segment, held": CodePath(("load_rows",)),
    "new segment, interpolated": CodePath(("load_axes",)),
    "frame started": CodePath(("tell_head",)),
    "axis reported": CodePath(("tell_axis",)),
    "frame ended": CodePath(("tell_end",)),
    "sample captured": CodePath(("capture_axis",)),
    "captured byte sent": CodePath(("tell_captured",)),
}

# Lengths of frames on the wire.
_SEGMENT_BYTES, _TELEMETRY_BYTES, _INPUTS_BYTES = 32, 31, 14


class _CaptureFrame(NamedTuple):
    byte_count: int
    sample_count: int


# By the number of captured axes.
_CAPTURE_FRAMES = {1: _CaptureFrame(32, 11), 3: _CaptureFrame(28, 3)}
# Bytes per second to and from the board in version 1 of the protocol. The host sent 200 set-points
# per second. The board answered each set-point with an acknowledgement and telemetry, and every
# fourth one also with inputs.
_VERSION_1_BYTES_PER_S = (200 * 25, 200 * (9 + 30 + _INPUTS_BYTES / 4))
# Three steppers at 10 mm/s, with a full step of 5 µm each.
_STEP_EDGES_HZ = 3 * 2000


@dataclass(frozen=True, slots=True)
class LoadCase:
    """Load case: rates of a board's activities at E = 2 MHz, Hz.

    In a stream with ``rows`` the command of each row is held, as in the streams of this host. A
    stream without rows is interpolated. The rate of step edges depends on the motor, not on the
    clock.
    """

    name: str
    board: str
    tick: int = 1000
    segments: int = 0
    rows: int = 0
    telemetry: int = 0
    # Number of captured axes, and sampling rate, Hz.
    captures: tuple[int, int] = (0, 0)
    step_edges_hz: int = 0

    def compute_line_bytes_per_s(self, clock_factor: int) -> tuple[float, float]:
        """Return the bytes per second to and from the board, at a clock of a multiple of 2 MHz."""
        telemetry_hz = self.telemetry * clock_factor
        bytes_out = telemetry_hz * (_TELEMETRY_BYTES + _INPUTS_BYTES / 4)
        axes, rate_hz = self.captures
        if axes:
            frame = _CAPTURE_FRAMES[axes]
            bytes_out += clock_factor * rate_hz / frame.sample_count * frame.byte_count
        return self.segments * clock_factor * float(_SEGMENT_BYTES), bytes_out

    def count_passes_per_s(self, clock_factor: int) -> Mapping[str, float]:
        """Return how often per second each path is executed, at a clock of a multiple of 2 MHz."""
        bytes_in, bytes_out = self.compute_line_bytes_per_s(clock_factor)
        axes, rate_hz = self.captures
        captured_values_hz = axes * rate_hz * clock_factor
        capture_frames_hz = (
            captured_values_hz / (_CAPTURE_FRAMES[axes].sample_count * axes) if axes else 0.0
        )
        telemetry_hz, segments_hz = self.telemetry * clock_factor, self.segments * clock_factor
        # Every fourth telemetry frame is followed by a frame of inputs.
        frames_hz = telemetry_hz * 1.25 + capture_frames_hz
        ticks_hz, rows_hz = self.tick * clock_factor, self.rows * clock_factor
        segment_kind = "held" if rows_hz else "interpolated"
        tick_rates = {f"tick, interpolated, {self.board}": ticks_hz}
        if rows_hz:
            tick_rates = {
                "tick, row held": ticks_hz - rows_hz,
                f"tick, new row, {self.board}": rows_hz,
            }
        return tick_rates | {
            "byte received": bytes_in,
            "byte decoded": bytes_in,
            "segment queued": segments_hz,
            f"new segment, {segment_kind}": segments_hz,
            "byte sent": bytes_out,
            # Three bytes of each frame are not encoded: both delimiters and the first length byte.
            "byte encoded": bytes_out - 3.0 * frames_hz,
            "frame started": frames_hz,
            "axis reported": 3.0 * telemetry_hz,
            "frame ended": frames_hz,
            "sample captured": captured_values_hz,
            "captured byte sent": 2.0 * captured_values_hz,
            "step edge": self.step_edges_hz,
        }


LOAD_CASES = (
    LoadCase(
        "micro, held rows",
        "micro",
        segments=50,
        rows=100,
        telemetry=100,
        step_edges_hz=_STEP_EDGES_HZ,
    ),
    LoadCase("nano, held rows", "nano", segments=50, rows=100, telemetry=100),
    LoadCase(
        "micro, interpolated", "micro", segments=50, telemetry=100, step_edges_hz=_STEP_EDGES_HZ
    ),
    LoadCase("nano, interpolated", "nano", segments=50, telemetry=100),
    LoadCase("micro, capture of one axis at 1 kHz", "micro", telemetry=25, captures=(1, 1000)),
    LoadCase("nano, capture of one axis at 1 kHz", "nano", telemetry=25, captures=(1, 1000)),
    LoadCase("micro, capture of three at 250 Hz", "micro", telemetry=25, captures=(3, 250)),
    LoadCase("nano, capture of three at 250 Hz", "nano", telemetry=25, captures=(3, 250)),
)


def assemble_hot_paths() -> Routines:
    """Assemble the time-critical routines of the firmware.

    Raises
    ------
    BudgetError
        If the assembler is missing or reports an error.
    """
    with as_file(files("rotemina.drivers.mc68hc11") / "firmware") as folder:
        return assemble_sources(folder, SOURCES)


def compute_load(case: LoadCase, routines: Routines, clock_hz: int) -> float:
    """Return the fraction of the processor time that a case takes at a clock E, Hz."""
    clock_factor = clock_hz // CLOCKS_HZ[0]
    cycles_per_s = sum(
        rate_hz * PATHS[name].count_cycles(routines)
        for name, rate_hz in case.count_passes_per_s(clock_factor).items()
        if rate_hz
    )
    return cycles_per_s / clock_hz


def format_report(routines: Routines) -> list[str]:
    """Return the lines of the report."""
    lines = [f"{'path':32}{'cycles':>8}{'masked':>8}"]
    for name, path in PATHS.items():
        masked_cycles = path.count_masked_cycles(routines)
        lines.append(f"{name:32}{path.count_cycles(routines):8}{masked_cycles or '':>8}")
    bytes_in, bytes_out = _VERSION_1_BYTES_PER_S
    cycles_per_received_byte = PATHS["byte received"].count_cycles(routines) + PATHS[
        "byte decoded"
    ].count_cycles(routines)
    cycles_per_sent_byte = PATHS["byte sent"].count_cycles(routines) + PATHS[
        "byte encoded"
    ].count_cycles(routines)
    load = (bytes_in * cycles_per_received_byte + bytes_out * cycles_per_sent_byte) / CLOCKS_HZ[0]
    lines += ["", f"version 1 at 200 Hz: its bytes alone take {load:.0%} at 2 MHz"]
    lines += ["", f"{'case':40}{'2 MHz':>8}{'4 MHz':>8}   line at {BAUD} baud, to and from"]
    for case in LOAD_CASES:
        loads = (f"{compute_load(case, routines, clock_hz):8.0%}" for clock_hz in CLOCKS_HZ)
        lines.append(f"{case.name:40}{''.join(loads)}   {_format_line_loads(case)}")
    for case in LOAD_CASES[2:4]:
        load = compute_load(replace(case, segments=2 * case.segments), routines, CLOCKS_HZ[0])
        lines.append(f"{case.name}, a segment for each row: {load:.0%} at 2 MHz")
    return lines


def _format_line_loads(case: LoadCase) -> str:
    """Return the loads of the line in percent, in both directions and at both clocks."""
    loads = (
        f"{bytes_in * 10 / BAUD:.0%}, {bytes_out * 10 / BAUD:.0%}"
        for bytes_in, bytes_out in map(case.compute_line_bytes_per_s, (1, 2))
    )
    return "; ".join(loads)


def main(arguments: Sequence[str] = ()) -> int:
    """Print cycles and loads. Return the exit status, which is 2 if counting fails."""
    if arguments:
        print("rotemina: the budget takes no arguments", file=sys.stderr)
        return 2
    try:
        print("\n".join(format_report(assemble_hot_paths())))
    except BudgetError as error:
        print(f"rotemina: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
