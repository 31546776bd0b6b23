"""The status line: link, age of the data, latency of the last stop, work in the background."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.samples import DeviceState


class StatusText(QLabel):
    """One line that says how the connection stands."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setTextFormat(Qt.TextFormat.PlainText)
        self._busy = ""
        self._device = workbench.session.driver.name
        workbench.busy_changed.connect(self._set_busy)
        workbench.refreshed.connect(self._refresh)

    @staticmethod
    def activity(state: SessionState) -> str:
        """Return what the robot is doing, in a word or two."""
        if state.fault:
            return "failed – motion is locked"
        if state.activity is DeviceState.PLAYING:
            return f"playing {100.0 * state.progress:.0f} %"
        return str(state.activity)

    def _set_busy(self, text: str) -> None:
        self._busy = text

    def _refresh(self, state: SessionState) -> None:
        parts = [f"{self._device}: {state.connection}"]
        if state.age_s is not None:
            parts.append(f"data {1e3 * state.age_s:.0f} ms old")
        if state.stop_latency_s is not None:
            parts.append(f"last stop {1e3 * state.stop_latency_s:.1f} ms")
        if self._busy:
            parts.append(self._busy)
        self.setText("   ·   ".join(parts))
