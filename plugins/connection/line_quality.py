"""The quality of the line, and the latency of stops."""

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.figures import Figures
from rotemina.app.widgets.section import Section
from rotemina.plugins.connection import mark, tr
from rotemina.sim.quantities import fixed

_LINE = (
    mark("Frames sent"),
    mark("Frames received"),
    mark("Rejected"),
    mark("Repeated"),
    mark("Round trip"),
    mark("Load"),
)
_STOP = (
    mark("Latest"),
    mark("99.9 % of stops within"),
    mark("Worst"),
    mark("Last stop sent within"),
    mark("At rest after"),
)


class LineSection(Section):
    """Frames, losses, round trip and load."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Line"))
        self._session = workbench.session
        self.text = self.add_text()
        self.figures = Figures({tr(name): "" for name in _LINE})
        self.column.addWidget(self.figures)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        link = state.link
        self.text.setVisible(link is None)
        self.figures.setVisible(link is not None)
        if link is None:
            self.text.setText(tr("{name} has no open line.").format(name=self._session.driver.name))
            return
        self.figures.show_values(
            f"{link.sent}",
            f"{link.received}",
            f"{link.rejected}",
            f"{link.repeated}",
            milliseconds(link.round_trip_s),
            f"{fixed(100.0 * link.load, 0)} %",
        )


class StopSection(Section):
    """How long a stop takes to be out on the line, as of all the time."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Stop latency"))
        self.figures = Figures({tr(name): "" for name in _STOP})
        self.column.addWidget(self.figures)

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        latency = state.stop_latency
        self.figures.show_values(
            milliseconds(latency.latest if latency else None),
            milliseconds(latency.most if latency else None),
            milliseconds(latency.worst if latency else None),
            milliseconds(state.stop_latency_s),
            milliseconds(state.standstill_s),
        )


def milliseconds(seconds: float | None) -> str:
    """Return a short time as text."""
    return "–" if seconds is None else f"{fixed(1e3 * seconds, 2)} ms"
