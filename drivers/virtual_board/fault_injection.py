"""Injection of faults by text commands, for training and tests.

========================  ===================================================================
``drop N``                the next N bytes are lost
``double N``              each of the next N bytes arrives twice
``corrupt N``             one bit of each of the next N bytes is inverted
``delay T ms``            from now on bytes arrive later by T; ``delay 0 ms`` ends this
``garbage N``             N spurious bytes arrive
``silence T s``           no byte passes in either direction, as on a broken line
``space T s``             as ``silence``; boards also detect a break (line held at space)
``reset B``, ``brown-out B``  board B restarts and does not know the positions of its steppers
``freeze AXIS``, ``thaw AXIS``  the reading of the sensor stays constant until ``thaw``
``lose AXIS N``           a stepper loses N microsteps
``joystick X Y Z [B]``    set the joystick of board 1, 0 to 4095, and its buttons as bits
========================  ===================================================================

The first five commands may end with the receiver of the bytes, ``board`` (the default) or ``host``.
The first seven may name a line, ``line 1`` or ``line 2``. Otherwise they apply to all lines.
"""

from collections.abc import Callable, Sequence
from math import inf, isfinite

import numpy as np

from rotemina.drivers.contract import FaultCommandError
from rotemina.drivers.mc68hc11.protocol import BoardFault
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.drivers.virtual_board.line import SerialLine
from rotemina.drivers.virtual_board.line_faults import ByteDamage, CableChannel

_DAMAGE_COMMANDS = {
    "drop": ByteDamage.DROP,
    "double": ByteDamage.DOUBLE,
    "corrupt": ByteDamage.CORRUPT,
}
_RESET_COMMANDS = {"reset": BoardFault.RESET, "brown-out": BoardFault.BROWN_OUT}
_MAX_BYTES, _MAX_S, _MAX_STEPS = 10_000, 3600.0, 1_000_000
_MAX_READING, _MAX_BUTTONS = 4095, 3
_TIME_UNITS_S = {"s": 1.0, "ms": 1e-3}
_RANDOM_COMMANDS = ("drop 1", "double 1", "corrupt 1", "garbage 3", "delay 2 ms", "delay 0 ms")


def inject_fault(boards: VirtualBoards, command: str) -> None:
    """Execute a command at the current time of the boards.

    Raises
    ------
    FaultCommandError
        If the command is unknown, or there is no such axis, board or line.
    """
    name, *words = command.split() or [""]
    if name not in _HANDLERS:
        names = ", ".join(sorted(_HANDLERS))
        raise FaultCommandError(
            "fault {strip}: unknown command; use {known}", strip=repr(command.strip()), known=names
        )
    try:
        _HANDLERS[name](boards, name, words)
    except FaultCommandError as error:
        raise FaultCommandError(
            "fault {strip}: {error}", strip=repr(command.strip()), error=str(error)
        ) from error
    boards.notes.add_event(boards.now_s, f"injected: {' '.join(command.split())}")


class RandomFaults:
    """Disturbances of the lines at random times. None of them loses a position.

    Parameters
    ----------
    boards : VirtualBoards
    rate_hz : float
        Average number of disturbances per second.
    seed : int
    """

    def __init__(self, boards: VirtualBoards, rate_hz: float, seed: int) -> None:
        self._boards = boards
        self._rate_hz = rate_hz
        self._random = np.random.default_rng(seed)
        self._next_s = boards.now_s + self._draw_pause_s()

    def advance(self, to_s: float) -> None:
        """Advance the boards to the time ``to_s``, and inject disturbances on the way."""
        while self._next_s <= to_s:
            self._boards.advance(self._next_s)
            command = _RANDOM_COMMANDS[int(self._random.integers(len(_RANDOM_COMMANDS)))]
            receiver = ("board", "host")[int(self._random.integers(2))]
            inject_fault(self._boards, f"{command} {receiver}")
            self._next_s += self._draw_pause_s()
        self._boards.advance(to_s)

    def _draw_pause_s(self) -> float:
        return float(self._random.exponential(1.0 / self._rate_hz)) if self._rate_hz else inf


def _inject_damage(boards: VirtualBoards, name: str, words: list[str]) -> None:
    lines, towards_host = _parse_lines_and_receiver(boards, words)
    count = _parse_count(words, _MAX_BYTES)
    for line in lines:
        _select_channel(line, towards_host).damage(_DAMAGE_COMMANDS[name], count)


def _inject_garbage(boards: VirtualBoards, _: str, words: list[str]) -> None:
    lines, towards_host = _parse_lines_and_receiver(boards, words)
    count = _parse_count(words, _MAX_BYTES)
    for line in lines:
        noise = _select_channel(line, towards_host).draw_noise(count)
        line.disturb(noise, boards.now_s, towards_host=towards_host)


def _set_delay(boards: VirtualBoards, _: str, words: list[str]) -> None:
    lines, towards_host = _parse_lines_and_receiver(boards, words)
    delay_s = _parse_duration_s(words)
    for line in lines:
        _select_channel(line, towards_host).delay_s = delay_s


def _silence_lines(boards: VirtualBoards, name: str, words: list[str]) -> None:
    lines = _parse_lines(boards, words)
    until_s = boards.now_s + _parse_duration_s(words)
    for line in lines:
        if name == "space":
            # A break means stop at any time, even within a frame.
            line.disturb(b"\0\0", boards.now_s, towards_host=False)
        for channel in (line.to_board, line.to_host):
            channel.silent_until_s = until_s


def _reset_board(boards: VirtualBoards, name: str, words: list[str]) -> None:
    number = _parse_count(words, len(boards.boards))
    boards.boards[number - 1].reset(_RESET_COMMANDS[name])


def _freeze_or_thaw(boards: VirtualBoards, name: str, words: list[str]) -> None:
    index = _parse_axis(boards, words)
    _require_no_more_words(words)
    if name == "freeze":
        boards.machine.freeze_sensor(index)
    else:
        boards.machine.thaw_sensor(index)


def _lose_steps(boards: VirtualBoards, _: str, words: list[str]) -> None:
    index = _parse_axis(boards, words)
    if not boards.machine.is_stepper[index]:
        raise FaultCommandError(
            "{names} is not a stepper axis and has no steps", names=boards.machine.axis_names[index]
        )
    count = _parse_count(words, _MAX_STEPS)
    board = next(board for board in boards.boards if index in board.machine_indices)
    direction = board.last_directions[index - board.machine_indices.start]
    boards.machine.lose_steps(index, -count if direction < 0.0 else count)


def _set_joystick(boards: VirtualBoards, _: str, words: list[str]) -> None:
    numbers = [int(word) for word in words if word.isascii() and word.isdigit()]
    readings, buttons = numbers[:3], numbers[3:]
    is_valid = len(words) == len(numbers) in (3, 4) and max(readings) <= _MAX_READING
    if not is_valid or max(buttons, default=0) > _MAX_BUTTONS:
        raise FaultCommandError(
            "enter three readings, 0 to {most_reading}, then optionally buttons, 0 to "
            "{most_buttons}",
            most_reading=_MAX_READING,
            most_buttons=_MAX_BUTTONS,
        )
    boards.set_inputs((readings[0], readings[1], readings[2]), sum(buttons))


_HANDLERS: dict[str, Callable[[VirtualBoards, str, list[str]], None]] = {
    **dict.fromkeys(_DAMAGE_COMMANDS, _inject_damage),
    **dict.fromkeys(_RESET_COMMANDS, _reset_board),
    "garbage": _inject_garbage,
    "delay": _set_delay,
    "silence": _silence_lines,
    "space": _silence_lines,
    "freeze": _freeze_or_thaw,
    "thaw": _freeze_or_thaw,
    "lose": _lose_steps,
    "joystick": _set_joystick,
}


def _select_channel(line: SerialLine, towards_host: bool) -> CableChannel:
    return line.to_host if towards_host else line.to_board


def _parse_lines_and_receiver(
    boards: VirtualBoards, words: list[str]
) -> tuple[Sequence[SerialLine], bool]:
    """Remove the words for line and receiver. Return the lines, and whether the host receives."""
    lines = _parse_lines(boards, words)
    receiver = words.pop() if words and words[-1] in ("board", "host") else "board"
    return lines, receiver == "host"


def _parse_lines(boards: VirtualBoards, words: list[str]) -> Sequence[SerialLine]:
    if "line" not in words:
        return boards.serial_lines
    position = words.index("line")
    number_words = words[position + 1 : position + 2]
    del words[position : position + 2]
    return (boards.serial_lines[_parse_count(number_words, len(boards.serial_lines)) - 1],)


def _parse_axis(boards: VirtualBoards, words: list[str]) -> int:
    names = boards.machine.axis_names
    if not words or words[0] not in names:
        raise FaultCommandError("enter an axis: one of {names}", names=", ".join(names))
    return names.index(words.pop(0))


def _parse_count(words: list[str], maximum: int) -> int:
    """Remove the last remaining word, and return it as a number from 1 to a maximum."""
    word = words.pop(0) if words else ""
    _require_no_more_words(words)
    if not (word.isascii() and word.isdigit() and 1 <= int(word[:9]) <= maximum):
        raise FaultCommandError(
            "{word} must be a number from 1 to {most}", word=repr(word), most=maximum
        )
    return int(word)


def _parse_duration_s(words: list[str]) -> float:
    number, unit = [*words, "", ""][:2]
    _require_no_more_words(words[2:])
    try:
        value_s = float(number) * _TIME_UNITS_S[unit]
    except (KeyError, ValueError):
        value_s = inf
    if not (isfinite(value_s) and 0.0 <= value_s <= _MAX_S):
        raise FaultCommandError(
            "enter a time such as '5 ms' or '2 s', at most {most_s} s", most_s=_MAX_S
        )
    return value_s


def _require_no_more_words(words: list[str]) -> None:
    if words:
        raise FaultCommandError("{names} is not allowed here", names=repr(" ".join(words)))
