"""Check of a panel: whether it can be made, painted, updated and closed."""

from PySide6.QtCore import QCoreApplication, QEvent

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


def check_panel(kind: type[Panel], robot: str = "rotemina") -> tuple[Result, ...]:
    """Check a panel beside a simulated machine, without a display."""
    return results((described, painted, informed, closed), lambda: panel_bench(kind, robot))


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
