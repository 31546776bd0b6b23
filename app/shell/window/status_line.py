"""The status line: state, age of the data, stop latency, background work."""

from rotemina.app.language import translate
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import Workbench
from rotemina.sim.messages import format_fixed


class StatusText(ElidedLabel):
    """One line with the state of the machine and the age and latency of its connection."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._activity = ""
        self._workbench, self._session = workbench, workbench.session
        workbench.jobs.busy_changed.connect(self._set_busy)
        workbench.refreshed.connect(self._refresh)

    def _set_busy(self, text: str) -> None:
        self._activity = text

    def _refresh(self, state: SessionState) -> None:
        headword = self._workbench.describe(state).headword
        parts = [f"{self._session.driver.name}: {headword}"]
        if state.age_s is not None:
            parts.append(
                translate("shell", "data {age} old").format(age=format_data_age(state.age_s))
            )
        if state.stop_latency is not None:
            parts.append(
                translate("shell", "stop latency {ms:.1f} ms (99.9 %)").format(
                    ms=1e3 * state.stop_latency.p99_9_s
                )
            )
        if state.stop_latency_s is not None:
            parts.append(
                translate("shell", "last stop {ms:.1f} ms").format(ms=1e3 * state.stop_latency_s)
            )
        parts += [self._activity] if self._activity else []
        self.show_text("   ·   ".join(parts))


def format_data_age(seconds: float) -> str:
    """Return an age as text: in milliseconds below a second, then in seconds."""
    return (
        f"{format_fixed(1e3 * seconds, 0)} ms" if seconds < 1.0 else f"{format_fixed(seconds, 0)} s"
    )
