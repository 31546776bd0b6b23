"""View of the result of a calibration: errors before and after, and its key figures."""

from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QSplitter, QWidget

from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.drawing import LineStyle, SignalPlot
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable, make_colour_legend, make_plain_label
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.words import (
    FIGURE_HEADINGS,
    ISO_HEADINGS,
    CalibrationCurves,
    describe_verdict,
    make_error_curves,
    make_rows_of_figures,
    make_rows_of_iso,
    translate_headings,
)
from rotemina.sim.calibration import SensorCalibration

_STORE_TOOLTIP = mark(
    "Store this calibration with its date, and correct the readings of the axis with it from now on"
)


class CalibrationResultView(QWidget):
    """View with a plot, a table of key figures, and a button to store the result.

    The view fills the table ``iso`` with the figures of ISO 230-2. The panel shows that table in a
    separate tab.

    Signals
    -------
    stored() : the operator wants to store the result.
    """

    stored = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._curves: CalibrationCurves | None = None
        self.title = QLabel()
        self.title.setTextFormat(Qt.TextFormat.RichText)
        self.plot = SignalPlot(theme)
        self.plot.setMinimumSize(160, 90)
        for name, role in (("before", "real"), ("after", "good"), ("", "command")):
            self.plot.add_curve(name, LineStyle(role))
        self.figures, self.iso = (
            TextTable(name, translate_headings(headings), selectable=False)
            for name, headings in (
                (tr("Figures of the sensor"), FIGURE_HEADINGS),
                (tr("Figures of ISO 230-2"), ISO_HEADINGS),
            )
        )
        self.verdict = make_plain_label(quiet=False, wrap=True)
        self.store = QPushButton(tr("Store and use"))
        self.store.clicked.connect(self.stored)
        self._lay_out()
        self.show_result(None)

    def show_curves(self, curves: CalibrationCurves) -> None:
        """Draw curves in place of the previous ones."""
        self._curves = curves
        for name in ("before", "after", ""):
            self.plot.clear_signal(name)
        for name, _, values in curves.curves:
            self.plot.show_signal(name, curves.x, values)
        self.plot.getPlotItem().setLabel("bottom", curves.bottom_title)
        self.plot.enableAutoRange()
        self._write_title()

    def show_result(self, result: SensorCalibration | None) -> None:
        """Show a calibration. None clears the tables and the verdict."""
        self.figures.show_rows(make_rows_of_figures(result) if result is not None else ())
        self.iso.show_rows(make_rows_of_iso(result) if result is not None else ())
        self.verdict.setText(describe_verdict(result) if result is not None else "")
        self.verdict.setVisible(result is not None)
        objection = tr("there is no result yet") if result is None else result.refusal
        enable_unless(self.store, objection, tr(_STORE_TOOLTIP))
        if result is not None:
            self.show_curves(make_error_curves(result))

    def show_stored(self) -> None:
        """Show that the result has been stored."""
        enable_unless(self.store, tr("already stored"), tr(_STORE_TOOLTIP))

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of a theme."""
        self._theme = theme
        self.plot.set_theme(theme)
        self._write_title()

    def _write_title(self) -> None:
        if self._curves is None:
            return
        curves = self._curves.curves
        legend_entries = [(tr(name), role) for name, role, _ in curves if name]
        names = make_colour_legend(self._theme, legend_entries)
        self.title.setText(f"{escape(self._curves.left_title)}{': ' if names else ''}{names}")

    def _lay_out(self) -> None:
        plot_area = QWidget()
        make_column(self.title, (self.plot, 1), on=plot_area, margins=0, spacing=2)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        splitter.addWidget(plot_area)
        splitter.addWidget(self.figures)
        splitter.setSizes([380, 340])
        bottom_row = make_row((self.verdict, 1), 0)
        bottom_row.addWidget(self.store, 0, Qt.AlignmentFlag.AlignTop)
        make_column((splitter, 1), bottom_row, on=self, margins=0, spacing=4)
