"""Check of a panel: whether it can be made, painted, updated and closed."""

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QAbstractButton

from rotemina.app.motion.session import MotionSession
from rotemina.app.panel import Area, Panel
from rotemina.app.plugin_kit.escapes import escaped
from rotemina.app.plugin_kit.findings import results
from rotemina.app.plugin_kit.panel_bench import PanelBench, panel_bench
from rotemina.app.shell import theme as themes
from rotemina.drivers.conformance.check import Result
from rotemina.drivers.conformance.findings import demand

#: Width and height, px: a small dock, and most of a large screen.
_SIZES = ((300, 240), (1600, 1000))
_FRAMES = 10
#: How the machine gets into each state in which buttons are compared.
_STATES: dict[str, Callable[[MotionSession], object]] = {
    "connected": lambda session: None,
    "locked": MotionSession.emergency_stop,
    "disconnected": MotionSession.disconnect,
}


def check_panel(kind: type[Panel], robot: str = "rotemina") -> tuple[Result, ...]:
    """Check a panel beside a simulated machine, without a display."""
    return results(
        (described, painted, informed, enabled_at_once, closed), lambda: panel_bench(kind, robot)
    )


def described(bench: PanelBench) -> None:
    """Have a title and an area."""
    title, area = bench.panel.title, bench.panel.area
    demand(bool(title.strip()), f"the title {title!r}", "words for its frame and the menu")
    demand(isinstance(area, Area), f"the area {area!r}", f"one of {', '.join(Area)}")


def painted(bench: PanelBench) -> None:
    """Paint itself in every theme, small and large, and let nothing escape."""
    with escaped() as told:
        for theme in themes.THEMES.values():
            themes.dress(bench.panel, theme)
            bench.workbench.set_theme(theme)
            for width, height in _SIZES:
                bench.panel.resize(width, height)
                bench.panel.show()
                QCoreApplication.processEvents()
                bench.panel.grab()
    _require_none(told)


def informed(bench: PanelBench) -> None:
    """Follow the machine while an axis moves and while nothing is heard of it."""
    axis, described_axis = next(iter(bench.workbench.robot.axes.items()))
    with escaped() as told:
        bench.panel.show()
        bench.workbench.session.jog(axis, 1e-3 * described_axis.span)
        for _ in range(_FRAMES):
            bench.advance(0.04)
        bench.advance(5.0, read=False)
    _require_none(told)


def enabled_at_once(bench: PanelBench) -> None:
    """Enable its buttons before its first frame as after it: connected, locked, disconnected."""
    kept = bench.panel
    with escaped() as told:
        for name, enter in _STATES.items():
            kept.hide()
            bench.change_unseen(enter)
            made = bench.make_another()
            made.show()
            kept.show()
            for panel, when in ((made, "made"), (kept, "shown again")):
                wrong = _changed_by_refresh(bench, panel)
                demand(
                    not wrong,
                    f"{when} while the machine was {name}, the first refresh changed {wrong}",
                    "buttons that are enabled before the first frame as after it "
                    "(enable them in what Panel.follow calls)",
                )
            made.hide()
    _require_none(told)


def _changed_by_refresh(bench: PanelBench, panel: Panel) -> str:
    """Return the names of the buttons that are enabled otherwise after the first refresh."""
    before = {each: each.isEnabled() for each in panel.findChildren(QAbstractButton)}
    bench.emit_state()
    return ", ".join(
        repr(each.text() or each.accessibleName() or each.toolTip())
        for each in panel.findChildren(QAbstractButton)
        if before.get(each, each.isEnabled()) is not each.isEnabled()
    )


def closed(bench: PanelBench) -> None:
    """Leave nothing behind that fails once the panel is gone."""
    with escaped() as told:
        bench.panel.show()
        bench.refresh()
        bench.panel.close()
        bench.panel.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        bench.refresh()
    _require_none(told)


def _require_none(told: list[str]) -> None:
    demand(not told, "; ".join(dict.fromkeys(told)), "no exception and no complaint of Qt's")
