"""Row of controls for the axis, the input, the output, the view, and the view's settings."""

from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QPushButton, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.style import grow_with_text
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.findings import translate_text
from rotemina.plugins.identification.record_query import (
    AnalysisQuestion,
    AnalysisView,
    find_first_axis,
    find_taps,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot

AVERAGE_COUNTS = (4, 8, 16, 32, 64)
METHOD_ITEMS = ((mark("output error"), "oe"), ("ARX", "arx"))
POLE_COUNTS = (1, 2, 3, 4, 6)


class IdentificationControls(QWidget):
    """Choices and buttons of the panel.

    Signals
    -------
    question_changed() : the operator has changed the axis, a signal or a setting.
    view_changed() : the operator has chosen another view of the same question.
    """

    question_changed = Signal()
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
        self.axis = _make_choice(tr("Axis"))
        self.drive, self.answer = _make_choice(tr("Input")), _make_choice(tr("Output"))
        self.view = _make_choice(
            tr("Analysis"), [(translate_text(view.value), view) for view in AnalysisView]
        )
        averages_text = tr("{n} averages")
        self.averages = _make_choice(
            tr("Averages"),
            [(averages_text.format(n=count), count) for count in AVERAGE_COUNTS],
        )
        self.averages.setCurrentIndex(AVERAGE_COUNTS.index(8))
        self.averages.setToolTip(
            tr(
                "Segments of Welch's method: more segments smooth the curve, fewer resolve "
                "narrower peaks. A periodic record is averaged over its periods instead."
            )
        )
        self.method = _make_choice(
            tr("Method"), [(translate_text(name), method) for name, method in METHOD_ITEMS]
        )
        singular, plural = tr("1 pole"), tr("{n} poles")
        self.poles = _make_choice(
            tr("Poles"),
            [((plural if count > 1 else singular).format(n=count), count) for count in POLE_COUNTS],
        )
        self.poles.setCurrentIndex(POLE_COUNTS.index(2))
        self.copy, self.save = QPushButton(tr("Copy")), QPushButton(tr("Save …"))
        self.keep = QPushButton(tr("Store card"))
        self._lay_out()
        self.axis.activated.connect(self._change_axis)
        for choice in (self.drive, self.answer, self.averages, self.method, self.poles):
            choice.activated.connect(lambda _: self.question_changed.emit())
        self.view.currentIndexChanged.connect(self._change_view)
        self._show_settings()
        self._record: Record | None = None

    @property
    def current_view(self) -> AnalysisView:
        """The chosen view."""
        return AnalysisView(self.view.currentData())

    def offer_record(self, record: Record) -> None:
        """Offer the axes and taps of a record, and keep the current choices if possible."""
        self._record = record
        last_axis = self.axis.currentData()
        self.axis.clear()
        for name in record.axes:
            self.axis.addItem(get_axis_label(name), name)
        chosen_axis = last_axis if last_axis in record.axes else find_first_axis(record)
        self.axis.setCurrentIndex(record.axes.index(chosen_axis))
        self._offer_taps()

    def choose_view(self, axis: str, view: AnalysisView) -> None:
        """Choose an axis of the offered record, and a view."""
        self.axis.setCurrentIndex(self.axis.findData(axis))
        self._offer_taps()
        with QSignalBlocker(self.view):
            self.view.setCurrentIndex(self.view.findData(view))
        self._show_settings()

    def make_question(
        self, name: str, robot: Robot, folder: Path | None = None
    ) -> AnalysisQuestion | None:
        """Return the question about the record, or None if the axis lacks an input or an output."""
        if self._record is None or not (self.drive.count() and self.answer.count()):
            return None
        return AnalysisQuestion(
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
        make_row(*parts, on=self, margins=0, spacing=6)

    def _change_axis(self) -> None:
        self._offer_taps()
        self.question_changed.emit()

    def _offer_taps(self) -> None:
        assert self._record is not None
        inputs, outputs = find_taps(self._record, self.axis.currentData())
        for choice, taps, text in (
            (self.drive, inputs, tr("from {tap}")),
            (self.answer, outputs, tr("to {tap}")),
        ):
            last_tap = choice.currentData()
            choice.clear()
            for tap in taps:
                choice.addItem(text.format(tap=tap), str(tap))
            choice.setCurrentIndex(max(choice.findData(last_tap), 0))

    def _change_view(self) -> None:
        self._show_settings()
        self.view_changed.emit()

    def _show_settings(self) -> None:
        self.averages.setVisible(self.current_view is AnalysisView.FREQUENCY)
        for choice in (self.method, self.poles):
            choice.setVisible(self.current_view is AnalysisView.MODEL)
        self.keep.setVisible(self.current_view is AnalysisView.HEALTH)


def _make_choice(name: str, items: list[tuple[str, object]] | None = None) -> QComboBox:
    choice = name_widget(QComboBox(), name, name)
    choice.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    # In a narrow window the texts are elided, so that the whole row stays visible.
    grow_with_text(choice, choice.setMinimumWidth, 64)
    for text, data in items or []:
        choice.addItem(text, data)
    return choice
