"""The status line: state, age of the data, latency of stops, work in the background."""

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.language import translate
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.sim.quantities import fixed


class StatusText(ElidedLabel):
    """One line with the state of the machine and the figures of its connection."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._busy = ""
        self._workbench, self._session = workbench, workbench.session
        workbench.busy_changed.connect(self._set_busy)
        workbench.refreshed.connect(self._refresh)

    def _set_busy(self, text: str) -> None:
        self._busy = text

    def _refresh(self, state: SessionState) -> None:
        headword = self._workbench.describe(state).headword
        parts = [f"{self._session.driver.name}: {headword}"]
        if state.age_s is not None:
            parts.append(translate("shell", "data {age} old").format(age=age(state.age_s)))
        if state.stop_latency is not None:
            parts.append(
                translate("shell", "stop latency {ms:.1f} ms (99.9 %)").format(
                    ms=1e3 * state.stop_latency.most
                )
            )
        if state.stop_latency_s is not None:
            parts.append(
                translate("shell", "last stop {ms:.1f} ms").format(ms=1e3 * state.stop_latency_s)
            )
        parts += [self._busy] if self._busy else []
        self.show_text("   ·   ".join(parts))


def age(seconds: float) -> str:
    """Return an age as text: in milliseconds as long as data is fresh."""
    return f"{fixed(1e3 * seconds, 0)} ms" if seconds < 1.0 else f"{fixed(seconds, 0)} s"
