"""Fault injection by short commands, for training and tests.

========================  ===================================================================
``drop N``                the next N bytes are lost
``double N``              each of the next N bytes comes twice
``corrupt N``             a bit of each of the next N bytes is turned over
``delay T ms``            from now on bytes come this much later; ``delay 0 ms`` ends it
``garbage N``             N bytes come that nobody sent
``silence T s``           nothing comes through for so long, both ways: a torn or shorted line
``space T s``             the same, and boards hear a break: a line that is held at space
``reset B``, ``brown-out B``  board B begins again; it does not know where its steppers are
``freeze AXIS``, ``thaw AXIS``  a sensor says the same until it is thawed
``lose AXIS N``           a stepper stays N microsteps behind its command
``joystick X Y Z [B]``    hold the joystick of board 1 there, 0 to 4095, and buttons bit by bit
========================  ===================================================================

The first five take ``board`` (which is meant without it) or ``host``, towards which it happens; the
first seven ``line 1`` or ``line 2``, of all lines without it.
"""

from collections.abc import Callable, Sequence
from math import inf, isfinite

import numpy as np

from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.drivers.virtual_board.line import SerialLine
from rotemina.drivers.virtual_board.line_faults import Channel, Damage
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

_DAMAGES = {"drop": Damage.DROP, "double": Damage.DOUBLE, "corrupt": Damage.CORRUPT}
_RESETS = {"reset": Fault.RESET, "brown-out": Fault.BROWN_OUT}
_MOST_BYTES, _MOST_S, _MOST_STEPS = 10_000, 3600.0, 1_000_000
_MOST_READING, _MOST_BUTTONS = 4095, 3
_UNITS = {"s": 1.0, "ms": 1e-3}
_RANDOM = ("drop 1", "double 1", "corrupt 1", "garbage 3", "delay 2 ms", "delay 0 ms")


class FaultCommandError(InputError):
    """A command of fault injection that makes no sense; nothing has happened."""


def inject(boards: VirtualBoards, command: str) -> None:
    """Carry out a command at the boards' present time.

    Raises
    ------
    FaultCommandError
        If it is no command, or there is no such axis, board or line.
    """
    name, *words = command.split() or [""]
    if name not in _COMMANDS:
        known = ", ".join(sorted(_COMMANDS))
        raise FaultCommandError(
            message("engine", "fault {strip}: unknown command; use {known}").fill(
                strip=repr(command.strip()), known=known
            )
        )
    try:
        _COMMANDS[name](boards, name, words)
    except FaultCommandError as error:
        raise FaultCommandError(
            message("engine", "fault {strip}: {error}").fill(
                strip=repr(command.strip()), error=str(error)
            )
        ) from error
    boards.notes.say(boards.now_s, f"injected: {' '.join(command.split())}")


class RandomFaults:
    """Disturbances of the lines at random times; a position is never lost by them.

    Parameters
    ----------
    boards : VirtualBoards
    rate_hz : float
        How many a second, on average.
    seed : int
    """

    def __init__(self, boards: VirtualBoards, rate_hz: float, seed: int) -> None:
        self._boards = boards
        self._rate_hz = rate_hz
        self._chance = np.random.default_rng(seed)
        self._next_s = boards.now_s + self._pause_s()

    def live(self, to_s: float) -> None:
        """Advance until this time, s, with what goes wrong until then."""
        while self._next_s <= to_s:
            self._boards.live(self._next_s)
            what = _RANDOM[int(self._chance.integers(len(_RANDOM)))]
            where = ("board", "host")[int(self._chance.integers(2))]
            inject(self._boards, f"{what} {where}")
            self._next_s += self._pause_s()
        self._boards.live(to_s)

    def _pause_s(self) -> float:
        return float(self._chance.exponential(1.0 / self._rate_hz)) if self._rate_hz else inf


def _damage(boards: VirtualBoards, name: str, words: list[str]) -> None:
    lines, towards_host = _where(boards, words)
    count = _count(words, _MOST_BYTES)
    for line in lines:
        _channel(line, towards_host).damage(_DAMAGES[name], count)


def _garbage(boards: VirtualBoards, _: str, words: list[str]) -> None:
    lines, towards_host = _where(boards, words)
    count = _count(words, _MOST_BYTES)
    for line in lines:
        noise = _channel(line, towards_host).noise(count)
        line.disturb(noise, boards.now_s, towards_host=towards_host)


def _delay(boards: VirtualBoards, _: str, words: list[str]) -> None:
    lines, towards_host = _where(boards, words)
    delay_s = _duration_s(words)
    for line in lines:
        _channel(line, towards_host).delay_s = delay_s


def _silence(boards: VirtualBoards, name: str, words: list[str]) -> None:
    lines = _lines(boards, words)
    until_s = boards.now_s + _duration_s(words)
    for line in lines:
        if name == "space":
            # A break is a stop wherever it comes: within a frame too.
            line.disturb(b"\0\0", boards.now_s, towards_host=False)
        for channel in (line.to_board, line.to_host):
            channel.silent_until_s = until_s


def _reset(boards: VirtualBoards, name: str, words: list[str]) -> None:
    number = _count(words, len(boards.boards))
    boards.boards[number - 1].reset(_RESETS[name])


def _freeze(boards: VirtualBoards, name: str, words: list[str]) -> None:
    index = _axis(boards, words)
    _end(words)
    if name == "freeze":
        boards.machine.freeze(index)
    else:
        boards.machine.thaw(index)


def _lose(boards: VirtualBoards, _: str, words: list[str]) -> None:
    index = _axis(boards, words)
    if not boards.machine.stepper[index]:
        raise FaultCommandError(
            message("engine", "{names} is not a stepper axis and has no steps").fill(
                names=boards.machine.names[index]
            )
        )
    count = _count(words, _MOST_STEPS)
    board = next(one for one in boards.boards if index in one.indices)
    way = board.ways[index - board.indices.start]
    boards.machine.lose(index, -count if way < 0.0 else count)


def _joystick(boards: VirtualBoards, _: str, words: list[str]) -> None:
    numbers = [int(word) for word in words if word.isascii() and word.isdigit()]
    readings, buttons = numbers[:3], numbers[3:]
    right = len(words) == len(numbers) in (3, 4) and max(readings) <= _MOST_READING
    if not right or max(buttons, default=0) > _MOST_BUTTONS:
        raise FaultCommandError(
            message(
                "engine",
                "enter three readings, 0 to {most_reading}, then optionally buttons, 0 to "
                "{most_buttons}",
            ).fill(most_reading=_MOST_READING, most_buttons=_MOST_BUTTONS)
        )
    boards.set_inputs((readings[0], readings[1], readings[2]), sum(buttons))


_COMMANDS: dict[str, Callable[[VirtualBoards, str, list[str]], None]] = {
    **dict.fromkeys(_DAMAGES, _damage),
    **dict.fromkeys(_RESETS, _reset),
    "garbage": _garbage,
    "delay": _delay,
    "silence": _silence,
    "space": _silence,
    "freeze": _freeze,
    "thaw": _freeze,
    "lose": _lose,
    "joystick": _joystick,
}


def _channel(line: SerialLine, towards_host: bool) -> Channel:
    return line.to_host if towards_host else line.to_board


def _where(boards: VirtualBoards, words: list[str]) -> tuple[Sequence[SerialLine], bool]:
    """Take the words of line and direction off the end."""
    lines = _lines(boards, words)
    towards = words.pop() if words and words[-1] in ("board", "host") else "board"
    return lines, towards == "host"


def _lines(boards: VirtualBoards, words: list[str]) -> Sequence[SerialLine]:
    if "line" not in words:
        return boards.serial
    at = words.index("line")
    number = words[at + 1 : at + 2]
    del words[at : at + 2]
    return (boards.serial[_count(number, len(boards.serial)) - 1],)


def _axis(boards: VirtualBoards, words: list[str]) -> int:
    names = boards.machine.names
    if not words or words[0] not in names:
        raise FaultCommandError(
            message("engine", "enter an axis: one of {names}").fill(names=", ".join(names))
        )
    return names.index(words.pop(0))


def _count(words: list[str], most: int) -> int:
    """Take the only number that is left, 1 to ``most``."""
    word = words.pop(0) if words else ""
    _end(words)
    if not (word.isascii() and word.isdigit() and 1 <= int(word[:9]) <= most):
        raise FaultCommandError(
            message("engine", "{word} must be a number from 1 to {most}").fill(
                word=repr(word), most=most
            )
        )
    return int(word)


def _duration_s(words: list[str]) -> float:
    """Take the only duration that is left."""
    number, unit = [*words, "", ""][:2]
    _end(words[2:])
    try:
        value_s = float(number) * _UNITS[unit]
    except (KeyError, ValueError):
        value_s = inf
    if not (isfinite(value_s) and 0.0 <= value_s <= _MOST_S):
        raise FaultCommandError(
            message("engine", "enter a time such as '5 ms' or '2 s', at most {most_s} s").fill(
                most_s=_MOST_S
            )
        )
    return value_s


def _end(words: list[str]) -> None:
    if words:
        raise FaultCommandError(
            message("engine", "{names} is not allowed here").fill(names=repr(" ".join(words)))
        )
