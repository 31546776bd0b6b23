"""How the candidates of one axis stand while a diagnosis tries them: names, bars and shares."""

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.words import effect_title
from rotemina.sim.gap.compare.ranking import Grade, Ranking, Standing
from rotemina.sim.quantities import percent

_ROW = 20  # high
_ROOM = 6  # beside texts
_WIDTHS = (150, 240)  # at least, and as it likes to be
_SHOWN = 12  # candidates that the tooltip names
_STRENGTHS = {Grade.LOOK: 0, Grade.FIT: 60, Grade.UNSEEN: 130}  # of a bar's colour, of 255


class RankingView(QWidget):
    """The best candidates of an axis, as many as there is room for.

    A bar is the share of the gap that is closed: an outline at a first look, light once it is
    fitted, full once it is judged by data that the fit has not seen.
    """

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._being_fitted: str | None = None
        self.ranking: Ranking | None = None
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_ranking(self, ranking: Ranking, being_fitted: str | None) -> None:
        """Draw how candidates stand in place of the last; one of them may be being fitted."""
        if ranking is self.ranking and being_fitted == self._being_fitted:
            return
        self.ranking, self._being_fitted = ranking, being_fitted
        rows = [f"{name_of(one)} {percent(one.closed)}" for one in ranking.standings[:_SHOWN]]
        self.setAccessibleName(f"{self.heading()}: {', '.join(rows)}")
        self.setToolTip(plain_tip(self.heading(), *rows))
        self.update()

    def heading(self) -> str:
        """Return what stands above the bars."""
        if self.ranking is None:
            return ""
        axis, tried = label(self.ranking.axis), self.ranking.tried
        if tried == 1:
            return tr("{axis}: 1 candidate tried").format(axis=axis)
        return tr("{axis}: {n} candidates tried").format(axis=axis, n=tried)

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the room in which names can be read."""
        return QSize(_WIDTHS[1], 8 * _ROW)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the room for a few cut names."""
        return QSize(_WIDTHS[0], 4 * _ROW)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the heading and a row for each candidate."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.surface))
        if self.ranking is None:
            return
        row = QRect(0, 0, self.width(), _ROW)
        painter.setPen(QColor(self._theme.quiet))
        self._write(painter, row, self.heading(), "")
        for number, one in enumerate(self.ranking.standings, start=1):
            row = QRect(0, number * _ROW, self.width(), _ROW)
            if row.bottom() > self.height():
                break
            self._draw(painter, row, one)

    def _draw(self, painter: QPainter, row: QRect, one: Standing) -> None:
        colour = QColor(self._theme.accent)
        bar = row.adjusted(0, 1, -1, -2)
        bar.setWidth(max(round(bar.width() * one.closed), 1))
        fill = QColor(colour)
        fill.setAlpha(_STRENGTHS[one.grade])
        painter.fillRect(bar, fill)
        fitted = self._being_fitted is not None and self._being_fitted in dict(one.causes)
        painter.setPen(QPen(colour, 1, Qt.PenStyle.DotLine if fitted else Qt.PenStyle.SolidLine))
        painter.drawRect(bar)
        painter.setPen(QColor(self._theme.text))
        self._write(painter, row, name_of(one), percent(one.closed))

    def _write(self, painter: QPainter, row: QRect, name: str, figure: str) -> None:
        across = Qt.AlignmentFlag.AlignVCenter
        inner = row.adjusted(_ROOM, 0, -_ROOM, 0)
        painter.drawText(inner, int(across | Qt.AlignmentFlag.AlignRight), figure)
        metrics = self.fontMetrics()
        width = inner.width() - (metrics.horizontalAdvance(figure) + _ROOM if figure else 0)
        cut = metrics.elidedText(name, Qt.TextElideMode.ElideRight, width)
        painter.drawText(inner, int(across | Qt.AlignmentFlag.AlignLeft), cut)


def name_of(one: Standing) -> str:
    """Return what a set of causes is called."""
    if not one.causes:
        return tr("Model re-tuned")
    return " + ".join(_name(*cause) for cause in one.causes)


def _name(effect: str, source: str | None) -> str:
    title = effect_title(effect)
    if source is None:
        return title
    return tr("{effect} from {axis}").format(effect=title, axis=label(source))
