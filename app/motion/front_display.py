"""Text of the two-row display at the machine: mode, position and faults."""

from collections.abc import Callable
from textwrap import wrap

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.abilities import DISPLAY_COLUMNS, DISPLAY_ROWS
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.model import Robot

_PAGE_S = 2.0  # so long a part of a long text stands
_PLAIN = str.maketrans({"µ": "u", "μ": "u", "θ": "th", "″": '"', "²": "2", "·": "*", "→": ">"})
_DIGITS, _DECIMALS = 6, 3  # of each of three numbers, with a space between them
# What a stage's axes are shown in: the tables in mm, piezos in um and urad.
_MILLI, _MICRO = 1e3, 1e6
_TIP = "tip"


class FrontDisplay:
    """Keeps the display of the device in use up to date, if it has one.

    Only rows that have changed are sent, and none while a trajectory plays: the line is needed for
    set-points then.

    Parameters
    ----------
    session : MotionSession
    mode : callable
        Returns the name of the mode that is steered in.
    """

    def __init__(self, session: MotionSession, mode: Callable[[], str]) -> None:
        self._session = session
        self._mode = mode
        self._shown: list[str] = []

    def step(self, now_s: float) -> None:
        """Show the present state of the machine."""
        state = self._session.snapshot()
        if state.connection is not Connection.CONNECTED:
            self._shown = []  # another device may be connected next
            return
        if state.activity is DeviceState.PLAYING:
            return
        rows = rows_of(state, self._mode(), self._session.robot, now_s)
        known = self._shown or [""] * DISPLAY_ROWS
        try:
            for number, (text, before) in enumerate(zip(rows, known, strict=True)):
                if text != before:
                    self._session.service.show(number, text)
        except RefusedError:  # the connection has ended meanwhile
            return
        self._shown = list(rows)


def rows_of(state: SessionState, mode: str, robot: Robot, now_s: float) -> tuple[str, str]:
    """Return both rows.

    The upper row shows mode, units and state; the lower one shows faults, in parts, or else the
    targets of the axes of the mode, or of the tip.
    """
    word = _plain(str(state.phase))
    unit, numbers = _position(state, mode, robot)
    room = DISPLAY_COLUMNS - len(word) - 1
    above = f"{_plain(f'{mode} {unit}')[:room]:{room}} {word}"
    wrong = state.latched or state.fault or ("" if state.position_known else state.locked)
    return above, _part(wrong, now_s) if wrong else numbers


def _position(state: SessionState, mode: str, robot: Robot) -> tuple[str, str]:
    """Return units and numbers of a mode's axes; of the tip where it moves that."""
    if mode not in robot.stages and mode != "axes" and state.tip is not None:
        return f"{_TIP} mm", " ".join(_number(_MILLI * at) for at in state.tip)
    axes = robot.stages.get(mode, tuple(robot.axes))[:3]
    scale, units = _MILLI, ["mm"]
    if any(robot.axes[axis].kind == "piezo" for axis in axes):
        scale = _MICRO
        units = list(dict.fromkeys(f"u{robot.unit(axis) or 'm'}" for axis in axes))
    shown = [state.command.get(axis) for axis in axes]
    numbers = ["-" * _DIGITS if at is None else _number(scale * at) for at in shown]
    return " ".join(units), " ".join(numbers)


def _number(value: float) -> str:
    """Return a number of six characters; of more where it needs them before its point."""
    whole = len(f"{value:.0f}")
    decimals = min(max(0, _DIGITS - 1 - whole), _DECIMALS)
    return f"{value:.{decimals}f}".rjust(_DIGITS)


def _part(text: str, now_s: float) -> str:
    parts = wrap(_plain(text), DISPLAY_COLUMNS)
    return parts[int(now_s / _PAGE_S) % len(parts)]


def _plain(text: str) -> str:
    """Return a text in the characters that such a display has."""
    return text.translate(_PLAIN).encode("ascii", "replace").decode("ascii")
