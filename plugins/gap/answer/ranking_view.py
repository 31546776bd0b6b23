"""View of the ranked candidates of one axis during a diagnosis, with bars."""

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.words import effect_title
from rotemina.sim.gap.result import (
    Grade,
    Ranking,
    Standing,
)
from rotemina.sim.units import format_percent

_ROW_HEIGHT_PX = 20
_TEXT_MARGIN_PX = 6
_MIN_WIDTH_PX, _PREFERRED_WIDTH_PX = 150, 240

# The tooltip shows this many candidates. More of them would fill the screen.
_MAX_TOOLTIP_CANDIDATES = 12

# Alpha (0 to 255) of a bar by the grade of its candidate.
_GRADE_ALPHAS = {Grade.LOOK: 0, Grade.FIT: 60, Grade.UNSEEN: 130}


class RankingView(QWidget):
    """View of the best candidates of an axis, as many as fit.

    The length of a bar is the fraction of the gap that a candidate closes. The bar is an outline
    after the screening, light after the fit, and solid after the decision on validation data.
    """

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._fitted_candidate: str | None = None
        self.ranking: Ranking | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_ranking(self, ranking: Ranking, being_fitted: str | None) -> None:
        """Draw a ranking. ``being_fitted`` is the candidate that is being fitted, if any."""
        if ranking is self.ranking and being_fitted == self._fitted_candidate:
            return
        self.ranking, self._fitted_candidate = ranking, being_fitted
        rows = [
            f"{name_causes(standing)} {format_percent(standing.closed)}"
            for standing in ranking.standings[:_MAX_TOOLTIP_CANDIDATES]
        ]
        self.setAccessibleName(f"{self.make_heading()}: {', '.join(rows)}")
        self.setToolTip(make_tooltip(self.make_heading(), *rows))
        self.update()

    def make_heading(self) -> str:
        """Return the text above the bars."""
        if self.ranking is None:
            return ""
        axis, count = get_axis_label(self.ranking.axis), self.ranking.tried
        if count == 1:
            return tr("{axis}: 1 candidate tried").format(axis=axis)
        return tr("{axis}: {n} candidates tried").format(axis=axis, n=count)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return a size at which the names can be read."""
        return QSize(_PREFERRED_WIDTH_PX, 8 * _ROW_HEIGHT_PX)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return a size for a few elided names."""
        return QSize(_MIN_WIDTH_PX, 4 * _ROW_HEIGHT_PX)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the heading and a row for each candidate."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        if self.ranking is None:
            return
        row = QRect(0, 0, self.width(), _ROW_HEIGHT_PX)
        painter.setPen(QColor(self._theme.quiet))
        self._draw_texts(painter, row, self.make_heading(), "")
        for row_index, standing in enumerate(self.ranking.standings, start=1):
            row = QRect(0, row_index * _ROW_HEIGHT_PX, self.width(), _ROW_HEIGHT_PX)
            if row.bottom() > self.height():
                break
            self._draw_row(painter, row, standing)

    def _draw_row(self, painter: QPainter, row: QRect, standing: Standing) -> None:
        colour = QColor(self._theme.accent)
        bar = row.adjusted(0, 1, -1, -2)
        bar.setWidth(max(round(bar.width() * standing.closed), 1))
        fill = QColor(colour)
        fill.setAlpha(_GRADE_ALPHAS[standing.grade])
        painter.fillRect(bar, fill)
        is_being_fitted = self._fitted_candidate is not None and self._fitted_candidate in dict(
            standing.causes
        )
        style = Qt.PenStyle.DotLine if is_being_fitted else Qt.PenStyle.SolidLine
        painter.setPen(QPen(colour, 1, style))
        painter.drawRect(bar)
        painter.setPen(QColor(self._theme.text))
        self._draw_texts(painter, row, name_causes(standing), format_percent(standing.closed))

    def _draw_texts(self, painter: QPainter, row: QRect, name: str, percentage: str) -> None:
        vertical = Qt.AlignmentFlag.AlignVCenter
        text_area = row.adjusted(_TEXT_MARGIN_PX, 0, -_TEXT_MARGIN_PX, 0)
        painter.drawText(text_area, int(vertical | Qt.AlignmentFlag.AlignRight), percentage)
        metrics = self.fontMetrics()
        name_width = text_area.width() - (
            metrics.horizontalAdvance(percentage) + _TEXT_MARGIN_PX if percentage else 0
        )
        elided_name = metrics.elidedText(name, Qt.TextElideMode.ElideRight, name_width)
        painter.drawText(text_area, int(vertical | Qt.AlignmentFlag.AlignLeft), elided_name)


def name_causes(standing: Standing) -> str:
    """Return the name of a set of causes; the empty set is the re-tuned model."""
    if not standing.causes:
        return tr("Model re-tuned")
    return " + ".join(_name_cause(*cause) for cause in standing.causes)


def _name_cause(effect: str, source: str | None) -> str:
    title = effect_title(effect)
    if source is None:
        return title
    return tr("{effect} from {axis}").format(effect=title, axis=get_axis_label(source))
