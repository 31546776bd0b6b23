"""The row of choices: axis, input, output, view, and the settings of the visible view."""

from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QPushButton, QWidget

from rotemina.app.display_units import label
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.when_dressed import grow_with_text
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.filled_template import localized
from rotemina.plugins.identification.record_query import Question, first_axis, taps_of
from rotemina.plugins.identification.views import View
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

AVERAGES = (4, 8, 16, 32, 64)
METHODS = ((mark("output error"), "oe"), ("ARX", "arx"))
POLES = (1, 2, 3, 4, 6)


class Controls(QWidget):
    """Choices and buttons of the panel.

    Signals
    -------
    asked() : the pair or a setting was changed; the question is another.
    view_changed() : another view of the same question.
    """

    asked = Signal()
    view_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.open = QPushButton(tr("Open …"))
        self.open.setToolTip(tr("Open a record for this page only"))
        self.excite = QPushButton(tr("Excite"))
        self.excite.setCheckable(True)
        self.excite.setToolTip(
            tr("Choose a motion that excites an axis, play it and analyse the record")
        )
        self.axis = _choice(tr("Axis"))
        self.drive, self.answer = _choice(tr("Input")), _choice(tr("Output"))
        self.view = _choice(tr("Analysis"), [(localized(view.value), view) for view in View])
        averages = tr("{n} averages")
        self.averages = _choice(tr("Averages"), [(averages.format(n=n), n) for n in AVERAGES])
        self.averages.setCurrentIndex(AVERAGES.index(8))
        self.averages.setToolTip(
            tr(
                "Segments of Welch's method: more segments smooth the curve, fewer resolve "
                "narrower peaks. A periodic record is averaged over its periods instead."
            )
        )
        self.method = _choice(tr("Method"), [(localized(name), method) for name, method in METHODS])
        pole = tr("1 pole")
        poles = tr("{n} poles")
        self.poles = _choice(
            tr("Poles"), [((poles if n > 1 else pole).format(n=n), n) for n in POLES]
        )
        self.poles.setCurrentIndex(POLES.index(2))
        self.copy, self.save = QPushButton(tr("Copy")), QPushButton(tr("Save …"))
        self.keep = QPushButton(tr("Store card"))
        self._lay_out()
        self.axis.activated.connect(self._change_axis)
        for choice in (self.drive, self.answer, self.averages, self.method, self.poles):
            choice.activated.connect(lambda _: self.asked.emit())
        self.view.currentIndexChanged.connect(self._change_view)
        self._show_settings()
        self._record: Record | None = None

    @property
    def shown(self) -> View:
        """The view that is chosen."""
        return View(self.view.currentData())

    def offer(self, record: Record) -> None:
        """Offer the axes and taps of a record; the choice stays where the record has it."""
        self._record = record
        kept = self.axis.currentData()
        self.axis.clear()
        for name in record.axes:
            self.axis.addItem(label(name), name)
        chosen = kept if kept in record.axes else first_axis(record)
        self.axis.setCurrentIndex(record.axes.index(chosen))
        self._offer_taps()

    def look_at(self, axis: str, view: View) -> None:
        """Choose an axis of the record offered, and a view of it."""
        self.axis.setCurrentIndex(self.axis.findData(axis))
        self._offer_taps()
        with QSignalBlocker(self.view):
            self.view.setCurrentIndex(self.view.findData(view))
        self._show_settings()

    def question(self, name: str, robot: Robot, folder: Path | None = None) -> Question | None:
        """Return the query, or None if the axis has no pair of signals."""
        if self._record is None or not (self.drive.count() and self.answer.count()):
            return None
        return Question(
            name,
            self._record,
            robot,
            self.axis.currentData(),
            Tap(self.drive.currentData()),
            Tap(self.answer.currentData()),
            averages=self.averages.currentData(),
            method=self.method.currentData(),
            poles=self.poles.currentData(),
            folder=folder,
        )

    def _lay_out(self) -> None:
        choices = self.axis, self.drive, self.answer, self.view
        settings, results = (
            (self.averages, self.method, self.poles),
            (self.keep, self.copy, self.save),
        )
        parts = self.excite, self.open, *choices, *settings, 1, *results
        in_row(*parts, on=self, margins=0, spacing=6)

    def _change_axis(self) -> None:
        self._offer_taps()
        self.asked.emit()

    def _offer_taps(self) -> None:
        assert self._record is not None
        inputs, outputs = taps_of(self._record, self.axis.currentData())
        for choice, taps, word in (
            (self.drive, inputs, tr("from {tap}")),
            (self.answer, outputs, tr("to {tap}")),
        ):
            kept = choice.currentData()
            choice.clear()
            for tap in taps:
                choice.addItem(word.format(tap=tap), str(tap))
            choice.setCurrentIndex(max(choice.findData(kept), 0))

    def _change_view(self) -> None:
        self._show_settings()
        self.view_changed.emit()

    def _show_settings(self) -> None:
        self.averages.setVisible(self.shown is View.FREQUENCY)
        for choice in (self.method, self.poles):
            choice.setVisible(self.shown is View.MODEL)
        self.keep.setVisible(self.shown is View.HEALTH)


def _choice(name: str, items: list[tuple[str, object]] | None = None) -> QComboBox:
    choice = named(QComboBox(), name, name)
    choice.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    # Where the window is narrow, a text is cut rather than the row.
    grow_with_text(choice, choice.setMinimumWidth, 64)
    for text, data in items or []:
        choice.addItem(text, data)
    return choice
