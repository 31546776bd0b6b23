"""Text of the two-row display on the controller's front panel: mode, position and faults."""

from collections.abc import Callable
from textwrap import wrap

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.drivers.abilities import DISPLAY_COLUMNS, DISPLAY_ROWS
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot import Robot

# A long text is shown page by page, each page for this long.
_PAGE_PERIOD_S = 2.0
_ASCII_REPLACEMENTS = str.maketrans(
    {"µ": "u", "μ": "u", "θ": "th", "″": '"', "²": "2", "·": "*", "→": ">"}
)
# Three numbers of this width and the spaces between them fill a row.
_NUMBER_WIDTH, _MAX_DECIMALS = 6, 3
# Motorised stages are shown in mm, piezo axes in µm and µrad.
_MILLI_PER_UNIT, _MICRO_PER_UNIT = 1e3, 1e6
_TIP_LABEL = "tip"


class FrontDisplay:
    """Keeps the front display of the connected device up to date, if it has one.

    Only rows that have changed are sent. Nothing is sent during a playback, because the
    serial line is then needed for set-points.

    Parameters
    ----------
    session : MotionSession
    mode : callable
        Returns the name of the current steering mode.
    """

    def __init__(self, session: MotionSession, get_mode: Callable[[], str]) -> None:
        self._session = session
        self._get_mode = get_mode
        self._shown_rows: list[str] = []

    def step(self, now_s: float) -> None:
        """Show the current state of the machine."""
        state = self._session.snapshot()
        if state.connection is not ConnectionState.CONNECTED:
            # Another device with an empty display may be connected next.
            self._shown_rows = []
            return
        if state.activity is DeviceState.PLAYING:
            return
        rows = format_rows(state, self._get_mode(), self._session.robot, now_s)
        shown_rows = self._shown_rows or [""] * DISPLAY_ROWS
        try:
            for row_index, (text, shown_text) in enumerate(zip(rows, shown_rows, strict=True)):
                if text != shown_text:
                    self._session.service.show_text(row_index, text)
        except RequestRefusedError:
            # The connection has ended meanwhile.
            return
        self._shown_rows = list(rows)


def format_rows(state: SessionState, mode: str, robot: Robot, now_s: float) -> tuple[str, str]:
    """Return the texts of both rows.

    The upper row shows mode, units and state. The lower row shows a fault, page by page. Without
    a fault it shows the targets of the mode's axes, or the position of the tip.
    """
    phase_text = _to_ascii(str(state.phase))
    unit, numbers = _format_position(state, mode, robot)
    mode_width = DISPLAY_COLUMNS - len(phase_text) - 1
    upper = f"{_to_ascii(f'{mode} {unit}')[:mode_width]:{mode_width}} {phase_text}"
    # While the position is unknown, show why motion is locked.
    fault = state.latch_reason or state.fault or ("" if state.position_known else state.lock_reason)
    return upper, _select_page(fault, now_s) if fault else numbers


def _format_position(state: SessionState, mode: str, robot: Robot) -> tuple[str, str]:
    """Return units and numbers of a mode's axes, or of the tip in a mode that moves the tip."""
    if mode not in robot.stages and mode != "axes" and state.tip is not None:
        return f"{_TIP_LABEL} mm", " ".join(
            _format_number(_MILLI_PER_UNIT * position) for position in state.tip
        )
    axes = robot.stages.get(mode, tuple(robot.axes))[:3]
    scale, units = _MILLI_PER_UNIT, ["mm"]
    if any(robot.axes[axis].kind == "piezo" for axis in axes):
        scale = _MICRO_PER_UNIT
        units = list(dict.fromkeys(f"u{robot.unit(axis) or 'm'}" for axis in axes))
    targets = [state.command.get(axis) for axis in axes]
    numbers = [
        "-" * _NUMBER_WIDTH if position is None else _format_number(scale * position)
        for position in targets
    ]
    return " ".join(units), " ".join(numbers)


def _format_number(value: float) -> str:
    """Return a number in six characters, or more if its integer part is longer."""
    integer_width = len(f"{value:.0f}")
    decimals = min(max(0, _NUMBER_WIDTH - 1 - integer_width), _MAX_DECIMALS)
    return f"{value:.{decimals}f}".rjust(_NUMBER_WIDTH)


def _select_page(text: str, now_s: float) -> str:
    pages = wrap(_to_ascii(text), DISPLAY_COLUMNS)
    return pages[int(now_s / _PAGE_PERIOD_S) % len(pages)]


def _to_ascii(text: str) -> str:
    return text.translate(_ASCII_REPLACEMENTS).encode("ascii", "replace").decode("ascii")
