"""Sections with the quality of the communication line, and with the latency of stops."""

from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import ValueGrid
from rotemina.app.workbench import Workbench
from rotemina.plugins.connection import mark, tr
from rotemina.sim.messages import format_fixed

_LINE_STATISTICS = (
    mark("Frames sent"),
    mark("Frames received"),
    mark("Rejected"),
    mark("Repeated"),
    mark("Round trip"),
    mark("Load"),
)
_STOP_STATISTICS = (
    mark("Latest"),
    mark("99.9 % of stops within"),
    mark("Worst"),
    mark("Last stop sent within"),
    mark("Standstill after the last stop"),
)


class LineQualitySection(Section):
    """Section with the frame counters, round-trip time and load of the line."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Line"))
        self._session = workbench.session
        self.text = self.add_text()
        self.figures = ValueGrid({tr(name): "" for name in _LINE_STATISTICS})
        self.column.addWidget(self.figures)

    def refresh(self, state: SessionState) -> None:
        """Show the link statistics of the session."""
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
            format_milliseconds(link.round_trip_s),
            f"{format_fixed(100.0 * link.load, 0)} %",
        )


class StopLatencySection(Section):
    """Section with the stop latency in this session, and the timing of the last stop.

    The stop latency is the time from the request until the stop is sent to the device.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Stop latency"))
        self.figures = ValueGrid({tr(name): "" for name in _STOP_STATISTICS})
        self.column.addWidget(self.figures)

    def refresh(self, state: SessionState) -> None:
        """Show the statistics of the session and the timing of its last stop."""
        latency = state.stop_latency
        self.figures.show_values(
            format_milliseconds(latency.latest if latency else None),
            format_milliseconds(latency.p99_9_s if latency else None),
            format_milliseconds(latency.worst if latency else None),
            format_milliseconds(state.stop_latency_s),
            format_milliseconds(state.standstill_s),
        )


def format_milliseconds(seconds: float | None) -> str:
    """Return a time in seconds as text in milliseconds, or a dash for None."""
    return "–" if seconds is None else f"{format_fixed(1e3 * seconds, 2)} ms"
