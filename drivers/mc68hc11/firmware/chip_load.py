"""The load of the chip, case by case: ``python -m rotemina.drivers.mc68hc11.firmware.chip_load``.

The hot paths are assembled and counted; a case says how often a second each is gone through. What
is not on a hot path (the main loop's own looking round, orders, homing) is not in it.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.resources import as_file, files

from rotemina.drivers.mc68hc11.firmware.cycles import (
    ENTRY,
    BudgetError,
    Routines,
    assembled,
    counted,
    masked,
)

SOURCES = ("serial", "motion", "telemetry")
CLOCKS_HZ = (2_000_000, 4_000_000)
BAUD = 125_000
MOST_MASKED = 90  # cycles
_CALL = 6  # JSR; its RTS is in the routine


@dataclass(frozen=True, slots=True)
class Path:
    """One way through the firmware: the labels that it passes, from each to the next one."""

    labels: tuple[str, ...]
    interrupt: bool = False

    def cycles(self, routines: Routines) -> int:
        """Return what it takes, with the interrupt's entry or the call."""
        code = [one for label in self.labels for one in _known(routines, label)]
        return counted(code) + (ENTRY if self.interrupt else _CALL)

    def masked(self, routines: Routines) -> int:
        """Return for how long it keeps interrupts out; nothing where it is none."""
        code = [one for label in self.labels for one in _known(routines, label)]
        return masked(code) if self.interrupt else 0


def _known(routines: Routines, label: str) -> list[tuple[int, ...]]:
    if label not in routines:
        raise BudgetError(f"the firmware has no label {label!r}")
    return routines[label]


PATHS = {
    "byte received": Path(("isr_serial", "isr_receive"), interrupt=True),
    "byte sent": Path(("isr_serial", "isr_send"), interrupt=True),
    "byte taken apart": Path(("take_byte", "take_plain")),
    "zero taken apart": Path(("take_byte", "take_stretch")),
    "byte checked and stuffed": Path(("put_byte", "put_plain")),
    "zero checked and stuffed": Path(("put_byte", "put_stretch")),
    "tick, row held": Path(("isr_held", "held"), interrupt=True),
    "tick, row begun, micro": Path(("isr_held", "row_axes", "micro_row"), interrupt=True),
    "tick, row begun, nano": Path(("isr_held", "row_axes", "nano_out"), interrupt=True),
    "tick, led, micro": Path(("isr_tick", "step_axes", "micro_out"), interrupt=True),
    "tick, led, nano": Path(("isr_tick", "step_axes", "nano_out"), interrupt=True),
    "step edge": Path(("isr_edge",), interrupt=True),
    "segment into the queue": Path(("take_segment",)),
    "segment begun, held": Path(("load_rows",)),
    "segment begun, led": Path(("load_axes",)),
    "frame begun": Path(("tell_head",)),
    "axis told": Path(("tell_axis",)),
    "frame ended": Path(("tell_end",)),
    "sample captured": Path(("capture_axis",)),
    "captured byte told": Path(("tell_captured",)),
}

# Bytes on the line, and those of a body that are checked and stuffed.
_SEGMENT, _TELEMETRY, _INPUTS = 32, 31, 14
_CAPTURED = {1: (32, 11), 3: (28, 3)}  # bytes, samples of a frame
# Version 1 on two lines at 200 Hz, a second: SetPoint; Done, Telemetry and a fourth of Inputs.
_VERSION_1 = (200 * 25, 200 * (9 + 30 + _INPUTS / 4))
_EDGES_HZ = 3 * 2000  # three steppers at 10 mm/s, a full step of 5 um each


@dataclass(frozen=True, slots=True)
class Case:
    """What a board does at once, each so often a second at E = 2 MHz.

    A stream with ``rows`` holds them, as our host's do; one without leads from segment to segment.
    Edges are as many at any clock: they are a matter of the motor.
    """

    name: str
    board: str
    tick: int = 1000
    segments: int = 0
    rows: int = 0
    telemetry: int = 0
    captures: tuple[int, int] = (0, 0)  # axes, Hz
    edges: int = 0

    def line(self, faster: int) -> tuple[float, float]:
        """Return bytes a second towards the board and from it."""
        telemetry = self.telemetry * faster
        out = telemetry * (_TELEMETRY + _INPUTS / 4)
        axes, rate_hz = self.captures
        if axes:
            size, samples = _CAPTURED[axes]
            out += faster * rate_hz / samples * size
        return self.segments * faster * float(_SEGMENT), out

    def often(self, faster: int) -> Mapping[str, float]:
        """Return how often a second each path is gone through."""
        into, out = self.line(faster)
        axes, rate_hz = self.captures
        captured = axes * rate_hz * faster
        frames = captured / (_CAPTURED[axes][1] * axes) if axes else 0.0
        telemetry, segments = self.telemetry * faster, self.segments * faster
        ended = telemetry * 1.25 + frames
        ticks, rows = self.tick * faster, self.rows * faster
        kind = "held" if rows else "led"
        moving = {f"tick, led, {self.board}": ticks}
        if rows:
            moving = {"tick, row held": ticks - rows, f"tick, row begun, {self.board}": rows}
        return moving | {
            "byte received": into,
            "byte taken apart": into,
            "segment into the queue": segments,
            f"segment begun, {kind}": segments,
            "byte sent": out,
            # Delimiters, and the lengths of stretches, are not put.
            "byte checked and stuffed": out - 3.0 * ended,
            "frame begun": ended,
            "axis told": 3.0 * telemetry,
            "frame ended": ended,
            "sample captured": captured,
            "captured byte told": 2.0 * captured,
            "step edge": self.edges,
        }


CASES = (
    Case("micro, held rows", "micro", segments=50, rows=100, telemetry=100, edges=_EDGES_HZ),
    Case("nano, held rows", "nano", segments=50, rows=100, telemetry=100),
    Case("micro, led", "micro", segments=50, telemetry=100, edges=_EDGES_HZ),
    Case("nano, led", "nano", segments=50, telemetry=100),
    Case("micro, capture of one axis at 1 kHz", "micro", telemetry=25, captures=(1, 1000)),
    Case("nano, capture of one axis at 1 kHz", "nano", telemetry=25, captures=(1, 1000)),
    Case("micro, capture of three at 250 Hz", "micro", telemetry=25, captures=(3, 250)),
    Case("nano, capture of three at 250 Hz", "nano", telemetry=25, captures=(3, 250)),
)


def hot_paths() -> Routines:
    """Assemble the firmware's hot paths.

    Raises
    ------
    BudgetError
        If the assembler is missing or refuses them.
    """
    with as_file(files("rotemina.drivers.mc68hc11") / "firmware") as folder:
        return assembled(folder, SOURCES)


def load(case: Case, routines: Routines, clock_hz: int) -> float:
    """Return the share of the chip that a case takes, at a clock E."""
    faster = clock_hz // CLOCKS_HZ[0]
    spent = sum(
        often * PATHS[name].cycles(routines) for name, often in case.often(faster).items() if often
    )
    return spent / clock_hz


def report(routines: Routines) -> list[str]:
    """Return the lines that are printed."""
    lines = [f"{'path':32}{'cycles':>8}{'masked':>8}"]
    for name, path in PATHS.items():
        kept_out = path.masked(routines)
        lines.append(f"{name:32}{path.cycles(routines):8}{kept_out or '':>8}")
    into, out = _VERSION_1
    received = PATHS["byte received"].cycles(routines) + PATHS["byte taken apart"].cycles(routines)
    sent = PATHS["byte sent"].cycles(routines) + PATHS["byte checked and stuffed"].cycles(routines)
    spent = (into * received + out * sent) / CLOCKS_HZ[0]
    lines += ["", f"version 1 at 200 Hz: its bytes alone take {spent:.0%} at 2 MHz"]
    lines += ["", f"{'case':40}{'2 MHz':>8}{'4 MHz':>8}   line at {BAUD} baud, to and from"]
    for case in CASES:
        loads = (f"{load(case, routines, clock_hz):8.0%}" for clock_hz in CLOCKS_HZ)
        lines.append(f"{case.name:40}{''.join(loads)}   {_lines_of(case)}")
    for case in CASES[2:4]:
        each_row = load(replace(case, segments=2 * case.segments), routines, CLOCKS_HZ[0])
        lines.append(f"{case.name}, a segment for each row: {each_row:.0%} at 2 MHz")
    return lines


def _lines_of(case: Case) -> str:
    """Return the shares of the line at both clocks."""
    shares = (
        f"{into * 10 / BAUD:.0%}, {out * 10 / BAUD:.0%}" for into, out in map(case.line, (1, 2))
    )
    return "; ".join(shares)


def main(arguments: Sequence[str] = ()) -> int:
    """Print cycles and loads; status 2 where they cannot be counted."""
    if arguments:
        print("rotemina: the budget takes no arguments", file=sys.stderr)
        return 2
    try:
        print("\n".join(report(hot_paths())))
    except BudgetError as error:
        print(f"rotemina: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
