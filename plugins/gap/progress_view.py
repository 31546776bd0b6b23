"""While a diagnosis is under way: what is done now, and how the candidates of each axis stand."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.ranking_view import RankingView
from rotemina.sim.gap.compare.diagnosis_progress import Progress

STAGES = {
    "reading": mark("Reading the records."),
    "where": mark("Locating the gap by axis, channel and frequency."),
    "screening": mark("Screening all effects that the axis may have."),
    "fitting": mark("Fitting the most likely candidates to the records, in parallel."),
    "deciding": mark("Deciding between the candidates on validation data."),
    "drawing": mark("Drawing the result."),
}


class ProgressView(QSplitter):
    """A ranking for each axis on the left, what is done now on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self.rankings: dict[str, RankingView] = {}
        self._row = in_row(margins=0, spacing=12)
        rankings = QWidget()
        rankings.setLayout(self._row)
        self.text = plain_text(quiet=False, wrap=True)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.text.setContentsMargins(10, 4, 4, 4)
        self.addWidget(rankings)
        self.addWidget(self.text)
        self.setSizes([640, 300])

    def begin(self) -> None:
        """Forget what was shown of the diagnosis before."""
        for view in self.rankings.values():
            self._row.removeWidget(view)
            view.deleteLater()
        self.rankings.clear()
        self.show_step(Progress("reading", None, None, 0.0))

    def show_step(self, step: Progress) -> None:
        """Show the current step and the candidates' state."""
        if step.ranking is not None and step.axis is not None:
            if step.axis not in self.rankings:
                view = self.rankings[step.axis] = RankingView(self._theme)
                self._row.addWidget(view)
            self.rankings[step.axis].show_ranking(step.ranking, _being_fitted(step))
        lines = [_of_axis(step.axis)] if step.axis is not None else []
        lines.append(tr(STAGES[step.stage]) if step.stage in STAGES else step.stage)
        lines += ["", _meaning()] if self.rankings else []
        self.text.setText("\n".join(lines))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        for view in self.rankings.values():
            view.set_theme(theme)


def _being_fitted(step: Progress) -> str | None:
    return step.candidate if step.stage == "fitting" else None


def _of_axis(axis: str) -> str:
    return tr("Axis {axis}.").format(axis=label(axis))


def _meaning() -> str:
    return tr(
        "A bar is the share of the gap that a candidate closes: outlined after "
        "screening, light after the fit, solid after the decision on validation "
        "data. The answer also considers which causes are needed together, and may "
        "differ."
    )
