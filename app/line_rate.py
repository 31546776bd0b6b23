"""Whether a serial adapter supports the boards' bit rate, the unusual 125 000 baud."""

import array
import struct
import sys

import serial

from rotemina.app.machine_check import Finding, State
from rotemina.drivers.mc68hc11.line_budget import BAUDS

_TOLERANCE = 0.02  # both ends together may be off by some 4 %
_TCGETS2 = 0x802C542A
_TERMIOS2 = struct.Struct("4IB19s2I")
_NAME = "line rate"


def line_rate(device: str, baud: int = BAUDS[0]) -> Finding:
    """Open a serial port at a rate and ask the system what it has become.

    What is connected may be reset by that, as some boards are whenever their port is opened.
    """
    try:
        with serial.Serial(device, baud, exclusive=True) as opened:
            made = _made(opened.fileno()) if sys.platform == "linux" else None
    except (serial.SerialException, OSError, ValueError) as error:
        return Finding(_NAME, State.LIMITED, f"{device}: {error}", _advice())
    if made is None:
        seen = f"{device}: takes {baud} baud; this system does not tell what it makes of it"
        return Finding(_NAME, State.GOOD, seen)
    seen = f"{device}: makes {made} baud of {baud}"
    if abs(made - baud) > _TOLERANCE * baud:
        return Finding(_NAME, State.LIMITED, seen, _advice())
    return Finding(_NAME, State.GOOD, seen)


def _advice() -> str:
    return (
        f"Take an adapter that makes {BAUDS[0]} baud (a divider of 3, 6 or 12 MHz does), or set "
        f"baud={BAUDS[1]} at both ends."
    )


def _made(handle: int) -> int | None:
    """Return the rate that the driver of a port says it has set; None where it does not tell."""
    import fcntl  # not on every system

    told = array.array("b", bytes(_TERMIOS2.size))
    try:
        fcntl.ioctl(handle, _TCGETS2, told)
    except OSError:
        return None
    *_, made = _TERMIOS2.unpack(told.tobytes())
    return int(made) or None
