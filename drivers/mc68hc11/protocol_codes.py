"""The numbers of the protocol: faults, refusals, states and abilities of a board."""

from enum import IntEnum, IntFlag

VERSION = 2
LCD_COLUMNS, LCD_ROWS = 20, 2
SEGMENTS = 32  # of an on-board profile
QUEUE = 32  # segments of set-points that wait in a board
AXES = 3  # of one board
VIRTUAL = b"virtual"  # what a board that is a program says of itself; real ones say nothing


class Fault(IntEnum):
    """Why a board halted; the first reason stays until it is cleared."""

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


class Refusal(IntEnum):
    """Why a board did not do what a frame asked."""

    UNKNOWN_TYPE = 1
    WRONG_LENGTH = 2
    BAD_VALUE = 3
    FAULTY = 4
    NOT_HOMED = 5
    BUSY = 6
    QUEUE_FULL = 7
    NOT_ABLE = 8
    OUT_OF_ORDER = 9


class Kind(IntEnum):
    """How an axis is moved."""

    STEPPER = 0
    PIEZO = 1


class Role(IntEnum):
    """The stage that an axis belongs to."""

    MICRO = 0
    NANO = 1


class Unit(IntEnum):
    """What steps of an axis are steps of."""

    M = 0
    RAD = 1


class State(IntFlag):
    """What a board is doing, bit by bit."""

    MOVING = 0x01
    PLAYING = 0x02
    HOMING = 0x04
    FAULT = 0x08
    CAPTURING = 0x10
    ARMED = 0x20
    POSITION_UNKNOWN = 0x40
    WRITING = 0x80


class Ability(IntFlag):
    """What a board can do beyond telling its position and stopping."""

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
