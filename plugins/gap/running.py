"""While a diagnosis is under way: what is done now, and the candidates as they rank so far."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QSplitter

from rotemina.app.display import label
from rotemina.app.shell.theme import Theme
from rotemina.plugins.gap.first_look import Look, Seen
from rotemina.plugins.gap.table import Table
from rotemina.sim.gap.progress import Progress
from rotemina.sim.gap.report.quantities import percent
from rotemina.sim.gap.report.words import effect_title

HEAD = ("candidate so far", "may close", "left [floors]")
STAGES = {
    "reading": "The records are read.",
    "where": "Where does the gap lie: on which axis, at which tap, in which frequencies?",
    "screening": "A first look at every effect that the axis may have.",
    "fitting": "The likeliest candidates are fitted to the records, one beside the other.",
    "deciding": "Which of them stands on data that its fit has not seen?",
    "drawing": "What was found is drawn.",
}
_WAITING = "No candidate was looked at yet."
_MEANING = (
    "On the left: by how much each effect alone might close the gap, at a first look at the "
    "beginning of each record. The answer rests on whole fits, and may be another."
)


class RunningView(QSplitter):
    """The ranking so far on the left, what is done now on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._look: Look | None = None
        self._fitted: str | None = None
        self.ranking = Table("Candidates so far, likeliest first", HEAD)
        self.ranking.setSelectionMode(Table.SelectionMode.NoSelection)
        self.ranking.setToolTip(_MEANING)
        self.text = QLabel()
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setWordWrap(True)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.text.setContentsMargins(10, 4, 4, 4)
        self.addWidget(self.ranking)
        self.addWidget(self.text)
        self.setSizes([480, 460])

    def begin(self) -> None:
        """Forget what was shown of the diagnosis before."""
        self._look = self._fitted = None
        self.ranking.show_rows([])
        self.show_step(Progress("reading", None, None, 0.0))

    def show_step(self, step: Progress) -> None:
        """Say what is done now."""
        if step.stage == "fitting" and step.candidate is not None:
            self._fitted = step.candidate
            self._show_ranking()
        axis = f"Axis {label(step.axis)}.\n" if step.axis is not None else ""
        looked = _WAITING if self._look is None else _looked(self._look)
        self.text.setText(f"{axis}{STAGES.get(step.stage, step.stage)}\n\n{looked}\n\n{_MEANING}")

    def show_look(self, look: Look) -> None:
        """Rank the candidates that were looked at so far."""
        if self._look is None or self._look.axis != look.axis:
            self._fitted = None
        self._look = look
        self._show_ranking()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self._show_ranking()

    def _show_ranking(self) -> None:
        look = self._look
        if look is None:
            return
        accent = QColor(self._theme.accent)
        self.ranking.show_rows(
            [_row(seen, look, fitted=seen.effect == self._fitted) for seen in look.seen],
            [accent if seen.effect == self._fitted else None for seen in look.seen],
        )


def _row(seen: Seen, look: Look, *, fitted: bool) -> tuple[str, ...]:
    name = effect_title(seen.effect)
    if seen.from_axis is not None:
        name += f" from {label(seen.from_axis)}"
    if fitted:
        name += "  (being fitted)"
    closes = max(1.0 - (seen.left**2 - 1.0) / max(look.whole**2 - 1.0, 1e-9), 0.0)
    return name, percent(min(closes, 1.0)), f"{seen.left:.3g}"


def _looked(look: Look) -> str:
    return (
        f"{label(look.axis)}: {look.done} of {look.count} candidates were looked at; "
        f"its gap is {look.whole:.3g} noise floors, rms."
    )
