"""Texts for the numbered errors and alarms of GRBL controllers.

Source: GRBL 1.1 (``doc/csv``), grblHAL (``errors.h``, ``alarms.h``), FluidNC (``Error.h``,
``Alarm.h``). The three agree on the low numbers and differ on the higher ones.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from rotemina.sim.messages import message

_COMMON_ERRORS = {
    1: message("engine", "a word does not begin with a letter"),
    2: message("engine", "a number is missing or malformed"),
    3: message("engine", "unknown command"),
    4: message("engine", "a number must not be negative"),
    5: message("engine", "homing is not enabled; set $22"),
    6: message("engine", "the step pulse is too short"),
    7: message("engine", "the stored settings could not be read; check the defaults that are used"),
    8: message("engine", "the controller is not idle"),
    9: message("engine", "the controller is locked by an alarm or busy with a jog"),
    10: message("engine", "soft limits need homing; set $22"),
    11: message("engine", "the line is too long"),
    12: message("engine", "the step rate is too high for the controller"),
    13: message("engine", "the safety door is open"),
    14: message("engine", "a stored line is too long"),
    15: message("engine", "the target lies beyond the travel"),
    16: message("engine", "not a valid jog command"),
    17: message("engine", "laser mode needs a spindle output with PWM"),
    20: message("engine", "unsupported G-code"),
    21: message("engine", "two G-codes of the same group are in one line"),
    22: message("engine", "the feed rate is missing"),
    23: message("engine", "a G-code needs a whole number"),
    24: message("engine", "two G-codes in one line both need axis words"),
    25: message("engine", "a word appears twice in a line"),
    26: message("engine", "axis words are missing"),
    27: message("engine", "the line number is not valid"),
    28: message("engine", "a G-code lacks a value"),
    29: message("engine", "this work coordinate system does not exist"),
    30: message("engine", "G53 needs G0 or G1"),
    31: message("engine", "the line has axis words but does not use them"),
    32: message("engine", "an arc needs an axis word in its plane"),
    33: message("engine", "the target of the motion is not valid"),
    34: message("engine", "the radius of the arc is not valid"),
    35: message("engine", "an arc needs an offset in its plane"),
    36: message("engine", "the line has unused words"),
    37: message("engine", "the tool length offset is for another axis"),
}
_GRBL_ERRORS = {
    38: message("engine", "the tool number is too large"),
}
_GRBL_HAL_ERRORS = {
    5: message("engine", "homing is not configured; set $22"),
    18: message("engine", "the controller was reset"),
    19: message("engine", "a number must be greater than zero"),
    38: message("engine", "the tool number is too large, or no tool is selected"),
    39: message("engine", "a value is out of range"),
    40: message("engine", "a tool change is pending"),
    41: message("engine", "the spindle does not turn"),
    42: message("engine", "the plane must be ZX"),
    43: message("engine", "the feed rate is too high"),
    44: message("engine", "the spindle speed is out of range"),
    45: message("engine", "a limit switch is pressed; only homing is possible"),
    46: message("engine", "home all axes first"),
    47: message("engine", "no tool is set"),
    48: message("engine", "two words of the line contradict each other"),
    49: message("engine", "the self-test failed; switch the controller off and on"),
    50: message("engine", "the emergency stop is pressed"),
    51: message("engine", "a motor reports a fault"),
    52: message("engine", "the setting is out of range"),
    53: message("engine", "this setting does not exist"),
    54: message("engine", "the retract position lies below the depth"),
    55: message("engine", "two axes with two motors each cannot be homed together"),
    56: message("engine", "the coordinate system is locked"),
    57: message("engine", "a file ends in an unexpected place"),
    58: message("engine", "the port does not exist"),
    60: message("engine", "the SD card cannot be mounted"),
    61: message("engine", "a file cannot be read"),
    62: message("engine", "a folder cannot be opened"),
    63: message("engine", "there is no such folder"),
    64: message("engine", "there is no SD card"),
    65: message("engine", "the file system is not mounted"),
    66: message("engine", "the file system is read-only"),
    70: message("engine", "Bluetooth cannot be started"),
    71: message("engine", "an expression has an unknown operator"),
    72: message("engine", "an expression divides by zero"),
    73: message("engine", "an argument of an expression is out of range"),
    74: message("engine", "an argument of an expression is not valid"),
    75: message("engine", "the syntax of an expression is wrong"),
    76: message("engine", "an expression has no finite result"),
    77: message("engine", "a password is needed"),
    78: message("engine", "access is denied"),
    79: message("engine", "the controller is locked by a critical event; reset it"),
    80: message("engine", "a flow command is outside a macro"),
    81: message("engine", "unknown flow command"),
    82: message("engine", "flow commands are nested too deeply"),
    83: message("engine", "the memory is full"),
    84: message("engine", "a file cannot be opened"),
    85: message("engine", "the file system cannot be formatted"),
    86: message("engine", "the port cannot be used for this"),
    87: message("engine", "a tool is in the spindle"),
    88: message("engine", "no tool is in the spindle"),
    89: message("engine", "a file cannot be deleted"),
    90: message("engine", "cutter compensation is already active"),
    91: message("engine", "this is not possible during cutter compensation"),
    92: message("engine", "cutter compensation does not fit this motion"),
    253: message("engine", "an error defined by the controller's maker or user"),
}
_FLUID_NC_ERRORS = {
    5: message("engine", "this setting is disabled"),
    18: message("engine", "no homing cycle is configured"),
    19: message("engine", "this axis cannot be homed alone"),
    38: message("engine", "a value is too large"),
    39: message("engine", "a P value is too large"),
    40: message("engine", "an input was active at start; check switches and buttons"),
    60: message("engine", "the storage cannot be mounted"),
    61: message("engine", "reading failed"),
    62: message("engine", "a folder cannot be opened"),
    63: message("engine", "there is no such folder"),
    64: message("engine", "a file is empty"),
    65: message("engine", "there is no such file"),
    66: message("engine", "a file cannot be opened"),
    67: message("engine", "the storage is busy"),
    68: message("engine", "a folder cannot be deleted"),
    69: message("engine", "a file cannot be deleted"),
    70: message("engine", "a file cannot be renamed"),
    80: message("engine", "the number is out of range for this setting"),
    81: message("engine", "the value is not valid for this setting"),
    82: message("engine", "a file cannot be created"),
    83: message("engine", "the file system cannot be formatted"),
    90: message("engine", "a message could not be sent"),
    100: message("engine", "a setting could not be stored"),
    101: message("engine", "the settings storage does not respond"),
    110: message("engine", "the password is wrong"),
    111: message("engine", "a line ends unexpectedly"),
    112: message("engine", "a file ends unexpectedly"),
    113: message("engine", "the controller was reset"),
    114: message("engine", "no data arrived"),
    120: message("engine", "another program or interface uses the controller"),
    130: message("engine", "the jog was cancelled"),
    150: message("engine", "a pin is configured incorrectly"),
    151: message("engine", "a setting in the configuration is not valid"),
    152: message("engine", "the configuration file is not valid; read the start-up messages"),
    160: message("engine", "an upload failed"),
    161: message("engine", "a download failed"),
    162: message("engine", "this setting is read-only"),
    170: message("engine", "an expression divides by zero"),
    171: message("engine", "an argument of an expression is not valid"),
    172: message("engine", "an expression has no finite result"),
    173: message("engine", "an expression has an unknown operator"),
    174: message("engine", "an argument of an expression is out of range"),
    175: message("engine", "the syntax of an expression is wrong"),
    176: message("engine", "unknown flow command"),
    177: message("engine", "a flow command is outside a macro"),
    178: message("engine", "the memory is full"),
    179: message("engine", "flow commands are nested too deeply"),
    180: message("engine", "a parameter cannot be set"),
    181: message("engine", "the value of a word is not valid"),
}
_COMMON_ALARMS = {
    1: message("engine", "hard limit: a limit switch was reached"),
    2: message("engine", "soft limit: a target lies beyond the travel"),
    3: message("engine", "the controller was reset during motion"),
    4: message("engine", "probe: not in the expected state before probing"),
    5: message("engine", "probe: no contact within the travel"),
    6: message("engine", "homing was ended by a reset"),
    7: message("engine", "the door was opened during homing"),
    8: message("engine", "homing: the pull-off did not clear the limit switch"),
    9: message("engine", "homing: the limit switch was not found"),
}
_GRBL_ALARMS = {
    10: message(
        "engine", "homing: the second limit switch of an axis with two motors was not found"
    ),
}
_GRBL_HAL_ALARMS = {
    10: message("engine", "the emergency stop is pressed; release it, then clear the fault"),
    11: message("engine", "home all axes first"),
    12: message("engine", "a limit switch is pressed; free the axis first"),
    13: message("engine", "the probe is in contact; free it first"),
    14: message("engine", "the spindle did not reach its speed"),
    15: message(
        "engine", "homing: the second limit switch of an axis with two motors was not found"
    ),
    16: message("engine", "the self-test failed; switch the controller off and on"),
    17: message("engine", "a motor reports a fault"),
    18: message("engine", "homing: not permitted by the configuration"),
    19: message("engine", "a Modbus device does not answer"),
    20: message("engine", "an input/output expander does not answer"),
    21: message("engine", "the stored settings cannot be read or written"),
    22: message("engine", "the input buffer overflowed"),
}
_FLUID_NC_ALARMS = {
    10: message("engine", "the spindle did not reach its speed"),
    11: message("engine", "an input was active at start; check switches and buttons"),
    12: message("engine", "homing: both ends of an axis report a limit switch"),
    13: message("engine", "the hard stop was pressed; release it, then clear the fault"),
    14: message("engine", "home all axes first"),
    15: message("engine", "the controller has just started; clear the fault, then home"),
    16: message("engine", "an input/output expander was reset"),
    17: message("engine", "a G-code error stopped the program"),
    18: message("engine", "a limit switch was reached while probing"),
}


class ControllerFirmware(StrEnum):
    """The firmware of a controller."""

    GRBL = "GRBL"
    GRBL_HAL = "grblHAL"
    FLUID_NC = "FluidNC"


_ERRORS = MappingProxyType(
    {
        ControllerFirmware.GRBL: _COMMON_ERRORS | _GRBL_ERRORS,
        ControllerFirmware.GRBL_HAL: _COMMON_ERRORS | _GRBL_HAL_ERRORS,
        ControllerFirmware.FLUID_NC: _COMMON_ERRORS | _FLUID_NC_ERRORS,
    }
)
_ALARMS = MappingProxyType(
    {
        ControllerFirmware.GRBL: _COMMON_ALARMS | _GRBL_ALARMS,
        ControllerFirmware.GRBL_HAL: _COMMON_ALARMS | _GRBL_HAL_ALARMS,
        ControllerFirmware.FLUID_NC: _COMMON_ALARMS | _FLUID_NC_ALARMS,
    }
)


def identify_firmware(texts: str) -> ControllerFirmware:
    """Identify the firmware from the greeting and the notes of a controller."""
    lowercase = texts.lower()
    if "fluidnc" in lowercase:
        return ControllerFirmware.FLUID_NC
    return ControllerFirmware.GRBL_HAL if "grblhal" in lowercase else ControllerFirmware.GRBL


def describe_error(number: int, firmware: ControllerFirmware) -> str:
    """Return the text of ``error:N`` for a user."""
    return _describe("error", number, _ERRORS[firmware], firmware)


def describe_alarm(number: int, firmware: ControllerFirmware) -> str:
    """Return the text of ``ALARM:N`` for a user."""
    return _describe("ALARM", number, _ALARMS[firmware], firmware)


def _describe(
    prefix: str, number: int, meanings: Mapping[int, str], firmware: ControllerFirmware
) -> str:
    unknown = message(
        "engine", "a number that {firmware} does not document; see the maker's manual"
    ).fill(firmware=firmware.value)
    return message("engine", "{what}:{number}, {meaning}").fill(
        what=prefix, number=number, meaning=meanings.get(number, unknown)
    )
