"""View of the progress of a diagnosis: the current step, and the candidates of each axis."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.ranking_view import RankingView
from rotemina.sim.gap.result import Progress

STAGE_SENTENCES = {
    "reading": mark("Reading the records."),
    "where": mark("Locating the gap by axis, channel and frequency."),
    "screening": mark("Screening all effects that the axis may have."),
    "fitting": mark("Fitting the most likely candidates to the records, in parallel."),
    "deciding": mark("Deciding between the candidates on validation data."),
    "drawing": mark("Drawing the result."),
}


class ProgressView(QSplitter):
    """View with a ranking for each axis on the left and the current step on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self.rankings: dict[str, RankingView] = {}
        self._row = make_row(margins=0, spacing=12)
        left = QWidget()
        left.setLayout(self._row)
        self.text = make_plain_label(quiet=False, wrap=True)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.text.setContentsMargins(10, 4, 4, 4)
        self.addWidget(left)
        self.addWidget(self.text)
        self.setSizes([640, 300])

    def begin(self) -> None:
        """Clear the view for a new diagnosis."""
        for view in self.rankings.values():
            self._row.removeWidget(view)
            view.deleteLater()
        self.rankings.clear()
        self.show_step(Progress("reading", None, None, 0.0))

    def show_step(self, step: Progress) -> None:
        """Show the current step and the state of the candidates."""
        if step.ranking is not None and step.axis is not None:
            if step.axis not in self.rankings:
                view = self.rankings[step.axis] = RankingView(self._theme)
                self._row.addWidget(view)
            self.rankings[step.axis].show_ranking(step.ranking, _find_fitted_candidate(step))
        lines = [_format_axis(step.axis)] if step.axis is not None else []
        lines.append(
            tr(STAGE_SENTENCES[step.stage]) if step.stage in STAGE_SENTENCES else step.stage
        )
        lines += ["", _explain_bars()] if self.rankings else []
        self.text.setText("\n".join(lines))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        for view in self.rankings.values():
            view.set_theme(theme)


def _find_fitted_candidate(step: Progress) -> str | None:
    return step.candidate if step.stage == "fitting" else None


def _format_axis(axis: str) -> str:
    return tr("Axis {axis}.").format(axis=get_axis_label(axis))


def _explain_bars() -> str:
    return tr(
        "A bar is the share of the gap that a candidate closes: outlined after "
        "screening, light after the fit, solid after the decision on validation "
        "data. The answer also considers which causes are needed together, and may "
        "differ."
    )
