"""Check whether a serial adapter supports the boards' unusual bit rate of 125 000 baud."""

import array
import struct
import sys

import serial

from rotemina.app.system.machine_check import CheckFinding, FindingState
from rotemina.drivers.mc68hc11 import BAUD_RATES

# The rates of both ends together may deviate by about 4 %. One end may deviate by half of that.
_MAX_RATE_ERROR_RATIO = 0.02
# Request number and layout of struct termios2 (Linux), which holds bit rates as numbers.
_TCGETS2 = 0x802C542A
_TERMIOS2 = struct.Struct("4IB19s2I")
_CHECK_NAME = "line rate"


def check_line_rate(device: str, baud: int = BAUD_RATES[0]) -> CheckFinding:
    """Open a serial port at a bit rate, and compare this rate with the one that the system sets.

    Opening a port resets some devices, such as some boards.
    """
    try:
        with serial.Serial(device, baud, exclusive=True) as port:
            actual_baud = _read_actual_baud(port.fileno()) if sys.platform == "linux" else None
    except (serial.SerialException, OSError, ValueError) as error:
        return CheckFinding(_CHECK_NAME, FindingState.LIMITED, f"{device}: {error}", _make_advice())
    if actual_baud is None:
        observation = f"{device}: accepts {baud} baud; this system does not report the actual rate"
        return CheckFinding(_CHECK_NAME, FindingState.GOOD, observation)
    observation = f"{device}: {actual_baud} baud at a setting of {baud}"
    if abs(actual_baud - baud) > _MAX_RATE_ERROR_RATIO * baud:
        return CheckFinding(_CHECK_NAME, FindingState.LIMITED, observation, _make_advice())
    return CheckFinding(_CHECK_NAME, FindingState.GOOD, observation)


def _make_advice() -> str:
    return (
        f"Use an adapter that supports {BAUD_RATES[0]} baud (a divider of 3, 6 or 12 MHz does), "
        f"or set baud={BAUD_RATES[1]} at both ends."
    )


def _read_actual_baud(file_descriptor: int) -> int | None:
    # Windows has no such module.
    import fcntl

    settings = array.array("b", bytes(_TERMIOS2.size))
    try:
        fcntl.ioctl(file_descriptor, _TCGETS2, settings)
    except OSError:
        return None
    *_, baud = _TERMIOS2.unpack(settings.tobytes())
    return int(baud) or None
