"""The result of a calibration: errors before and after, and figures."""

from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QSplitter, QWidget

from rotemina.app.shell.plot import Line, SignalPlot
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.labels import legend, plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.words import (
    FIGURES_HEAD,
    ISO_HEAD,
    Drawing,
    error_drawing,
    figures,
    iso,
    shown,
    verdict,
)
from rotemina.sim.calibration.sensor_calibration import Calibration

_TIP = mark(
    "Store this calibration with its date, and correct the readings of the axis with it from now on"
)


class ResultView(QWidget):
    """A plot beside the figures, and whether the result is to be stored.

    ``iso`` is the table of ISO 230-2, which stands elsewhere.

    Signals
    -------
    stored() : the operator wants to keep the result.
    """

    stored = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._drawing: Drawing | None = None
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        self.plot = SignalPlot(theme)
        self.plot.setMinimumSize(160, 90)
        for name, role in (("before", "real"), ("after", "good"), ("", "command")):
            self.plot.add_curve(name, Line(role))
        self.figures, self.iso = (
            Table(name, shown(head), choose=False)
            for name, head in (
                (tr("Figures of the sensor"), FIGURES_HEAD),
                (tr("Figures of ISO 230-2"), ISO_HEAD),
            )
        )
        self.verdict = plain_text(quiet=False, wrap=True)
        self.store = QPushButton(tr("Store and use"))
        self.store.clicked.connect(self.stored)
        self._lay_out()
        self.show_result(None)

    def show_drawing(self, drawing: Drawing) -> None:
        """Draw curves in place of the last."""
        self._drawing = drawing
        for name in ("before", "after", ""):
            self.plot.clear_signal(name)
        for name, _, values in drawing.curves:
            self.plot.show_signal(name, drawing.x, values)
        self.plot.getPlotItem().setLabel("bottom", drawing.bottom)
        self.plot.enableAutoRange()
        self._write_title()

    def show_result(self, result: Calibration | None) -> None:
        """Show a calibration, or its absence."""
        self.figures.show_rows(figures(result) if result is not None else ())
        self.iso.show_rows(iso(result) if result is not None else ())
        self.verdict.setText(verdict(result) if result is not None else "")
        self.verdict.setVisible(result is not None)
        why_not = tr("there is no result yet") if result is None else result.refusal
        allow(self.store, why_not, tr(_TIP))
        if result is not None:
            self.show_drawing(error_drawing(result))

    def done_storing(self) -> None:
        """Show that the result is kept."""
        allow(self.store, tr("already stored"), tr(_TIP))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._write_title()

    def _write_title(self) -> None:
        if self._drawing is None:
            return
        curves = self._drawing.curves
        named = [(tr(name), role) for name, role, _ in curves if name]
        names = legend(self._theme, named)
        self.title.setText(f"{escape(self._drawing.left)}{': ' if names else ''}{names}")

    def _lay_out(self) -> None:
        left = QWidget()
        in_column(self.title, (self.plot, 1), on=left, margins=0, spacing=2)
        tables = QSplitter(Qt.Orientation.Horizontal)
        tables.addWidget(left)
        tables.addWidget(self.figures)
        tables.setSizes([380, 340])
        foot = in_row((self.verdict, 1), 0)
        foot.addWidget(self.store, 0, Qt.AlignmentFlag.AlignTop)
        in_column((tables, 1), foot, on=self, margins=0, spacing=4)
