"""Check of a panel: whether it can be made, painted, updated and closed.

The name of each check function is the name of the check in the output, and its docstring is the
printed requirement.
"""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType

from PySide6.QtCore import (
    QCoreApplication,
    QEvent,
    QMessageLogContext,
    QtMsgType,
    qInstallMessageHandler,
)
from PySide6.QtWidgets import QAbstractButton

from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import Panel, PanelArea
from rotemina.app.plugin_kit.findings import run_plugin_checks
from rotemina.app.plugin_kit.panel_bench import PanelBench, open_panel_bench
from rotemina.app.shell.startup import OFFSCREEN_PREFIX
from rotemina.app.widgets.style import theme as themes
from rotemina.drivers.conformance import DriverCheckResult, require_that

# Width and height, px: a small dock, and most of a large screen.
_PANEL_SIZES_PX = ((300, 240), (1600, 1000))
_FRAME_COUNT = 10
# Functions that bring the machine into each state in which the buttons are checked.
_STATE_ENTRIES: dict[str, Callable[[MotionSession], object]] = {
    "connected": lambda session: None,
    "locked": MotionSession.emergency_stop,
    "disconnected": MotionSession.disconnect,
}
_WARNING_TYPES = (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg)


def check_panel(kind: type[Panel], robot: str = "rotemina") -> tuple[DriverCheckResult, ...]:
    """Check a panel with a simulated machine, without a display."""
    return run_plugin_checks(
        (described, painted, informed, enabled_at_once, closed),
        lambda: open_panel_bench(kind, robot),
    )


def described(bench: PanelBench) -> None:
    """Have a title and an area."""
    title, area = bench.panel.title, bench.panel.area
    require_that(bool(title.strip()), f"the title {title!r}", "a text for its frame and the menu")
    require_that(
        isinstance(area, PanelArea), f"the area {area!r}", f"one of {', '.join(PanelArea)}"
    )


def painted(bench: PanelBench) -> None:
    """Paint itself in every theme, small and large, without uncaught exceptions."""
    with collect_escaped_errors() as errors:
        for theme in themes.THEMES.values():
            themes.apply_theme(bench.panel, theme)
            bench.workbench.set_theme(theme)
            for width, height in _PANEL_SIZES_PX:
                bench.panel.resize(width, height)
                bench.panel.show()
                QCoreApplication.processEvents()
                bench.panel.grab()
    _require_no_errors(errors)


def informed(bench: PanelBench) -> None:
    """Follow the machine while an axis moves and while no samples arrive."""
    axis, axis_model = next(iter(bench.workbench.robot.axes.items()))
    with collect_escaped_errors() as errors:
        bench.panel.show()
        bench.workbench.session.jog(axis, 1e-3 * axis_model.span)
        for _ in range(_FRAME_COUNT):
            bench.advance(0.04)
        bench.advance(5.0, read=False)
    _require_no_errors(errors)


def enabled_at_once(bench: PanelBench) -> None:
    """Enable buttons alike before and after the first frame: connected, locked, disconnected."""
    old_panel = bench.panel
    with collect_escaped_errors() as errors:
        for state_name, enter_state in _STATE_ENTRIES.items():
            old_panel.hide()
            bench.change_without_update(enter_state)
            new_panel = bench.make_another()
            new_panel.show()
            old_panel.show()
            for panel, occasion in ((new_panel, "made"), (old_panel, "shown again")):
                changed_buttons = _find_changed_buttons(bench, panel)
                require_that(
                    not changed_buttons,
                    f"{occasion} while the machine was {state_name}, the first refresh changed "
                    f"{changed_buttons}",
                    "buttons that are enabled alike before and after the first frame "
                    "(enable them in a callback of Panel.follow)",
                )
            new_panel.hide()
    _require_no_errors(errors)


def _find_changed_buttons(bench: PanelBench, panel: Panel) -> str:
    """Return the names of the buttons that the first refresh enables or disables."""
    before = {button: button.isEnabled() for button in panel.findChildren(QAbstractButton)}
    bench.emit_state()
    return ", ".join(
        repr(button.text() or button.accessibleName() or button.toolTip())
        for button in panel.findChildren(QAbstractButton)
        if before.get(button, button.isEnabled()) is not button.isEnabled()
    )


def closed(bench: PanelBench) -> None:
    """Leave nothing behind that fails after the panel is deleted."""
    with collect_escaped_errors() as errors:
        bench.panel.show()
        bench.refresh()
        bench.panel.close()
        bench.panel.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        bench.refresh()
    _require_no_errors(errors)


def _require_no_errors(errors: list[str]) -> None:
    require_that(not errors, "; ".join(dict.fromkeys(errors)), "no exception and no warning of Qt")


@contextmanager
def collect_escaped_errors() -> Iterator[list[str]]:
    """Collect uncaught exceptions and Qt warnings during the context, one line each.

    An exception in a slot, a timer or a paint event does not propagate through Qt to the code that
    caused the event. Python calls ``sys.excepthook`` instead.
    """
    messages: list[str] = []

    def on_exception(
        kind: type[BaseException], error: BaseException, _trace: TracebackType | None
    ) -> None:
        messages.append(f"{kind.__name__}: {error}")

    def on_message(kind: QtMsgType, _context: QMessageLogContext, message: str) -> None:
        if kind in _WARNING_TYPES and not message.startswith(OFFSCREEN_PREFIX):
            messages.append(message)

    previous_hook, sys.excepthook = sys.excepthook, on_exception
    previous_handler = qInstallMessageHandler(on_message)
    try:
        yield messages
    finally:
        qInstallMessageHandler(previous_handler)
        sys.excepthook = previous_hook
