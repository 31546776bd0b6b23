"""Codes that the protocol defines: faults, refusals, states and abilities of a board."""

from enum import IntEnum, IntFlag

PROTOCOL_VERSION = 2
LCD_COLUMNS, LCD_ROWS = 20, 2
MAX_PROFILE_SEGMENTS = 32
# Segments of a stream that can wait in a board.
QUEUE_SEGMENTS = 32
AXES_PER_BOARD = 3
# The kind that a virtual board reports. Real boards report another kind, or none.
VIRTUAL_KIND = b"virtual"


class BoardFault(IntEnum):
    """Reason why a board halted. A board keeps the first reason until it is cleared."""

    NONE = 0
    STOPPED = 1
    WATCHDOG = 2
    LIMIT_SWITCH = 3
    SOFT_LIMIT = 4
    SENSOR = 5
    BROWN_OUT = 6
    RESET = 7
    LATE_SETPOINT = 8
    PROFILE = 9
    TOO_FAST = 10


class RefusalReason(IntEnum):
    """Reason why a board refused a frame."""

    UNKNOWN_TYPE = 1
    WRONG_LENGTH = 2
    BAD_VALUE = 3
    FAULTY = 4
    NOT_HOMED = 5
    BUSY = 6
    QUEUE_FULL = 7
    NOT_ABLE = 8
    OUT_OF_ORDER = 9


class ActuatorKind(IntEnum):
    """Type of the actuator that moves an axis."""

    STEPPER = 0
    PIEZO = 1


class StageCode(IntEnum):
    """Stage that an axis belongs to."""

    MICRO = 0
    NANO = 1


class StepUnit(IntEnum):
    """Unit of the steps of an axis."""

    M = 0
    RAD = 1


class BoardState(IntFlag):
    """State bits of a board."""

    MOVING = 0x01
    PLAYING = 0x02
    HOMING = 0x04
    FAULT = 0x08
    CAPTURING = 0x10
    ARMED = 0x20
    POSITION_UNKNOWN = 0x40
    WRITING = 0x80


class BoardAbility(IntFlag):
    """Ability bits of a board. Every board can also stop and report its position."""

    MOVE = 0x0001
    VELOCITY = 0x0002
    HOMING = 0x0004
    SETPOINTS = 0x0008
    DAC = 0x0010
    CAPTURE = 0x0020
    PROFILE = 0x0040
    JOYSTICK = 0x0080
    DISPLAY = 0x0100
    PARAMETERS = 0x0200
    HALF_DUPLEX = 0x0400
