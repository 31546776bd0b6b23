"""View of the stored calibrations, with buttons to switch them on and off."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.calibration import StoredCalibration
from rotemina.app.widgets.controls import enable_unless, make_tooltip
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import TextTable
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.words import STORED_HEADINGS, make_stored_row, translate_headings

_NONE_SELECTED_TEXT = mark("select a calibration in the table")


class StoredCalibrationsView(QWidget):
    """Table of the stored calibrations, with buttons to use one or switch it off.

    Signals
    -------
    switched(str, object) : axis, and path of the calibration that the axis is to use, or None.
    """

    switched = Signal(str, object)

    def __init__(self) -> None:
        super().__init__()
        self.stored: tuple[StoredCalibration, ...] = ()
        self.table = TextTable(tr("Stored calibrations"), translate_headings(STORED_HEADINGS))
        self.table.itemSelectionChanged.connect(self._update_buttons)
        self.use_button, self.switch_off_button = (
            QPushButton(tr("Use")),
            QPushButton(tr("Switch off")),
        )
        self.use_button.clicked.connect(lambda: self._switch(on=True))
        self.switch_off_button.clicked.connect(lambda: self._switch(on=False))
        make_column(
            (self.table, 1),
            make_row(1, self.use_button, self.switch_off_button),
            on=self,
            margins=0,
            spacing=4,
        )
        self._update_buttons()

    @property
    def selected(self) -> StoredCalibration | None:
        """The selected calibration, or None."""
        rows = {index.row() for index in self.table.selectedIndexes()}
        return self.stored[rows.pop()] if rows else None

    def show_stored(self, stored: tuple[StoredCalibration, ...]) -> None:
        """Show the stored calibrations, and keep the selection."""
        selected = self.selected
        self.table.clearSelection()
        self.stored = stored
        self.table.show_rows(tuple(map(make_stored_row, stored)))
        for row, entry in enumerate(stored):
            self.table.item(row, 0).setToolTip(
                make_tooltip(str(entry.path), entry.calibration.name)
            )
            if selected is not None and entry.path == selected.path:
                self.table.selectRow(row)
        self._update_buttons()

    def _switch(self, *, on: bool) -> None:
        selected = self.selected
        if selected is not None:
            path: Path | None = selected.path if on else None
            self.switched.emit(selected.calibration.axis, path)

    def _update_buttons(self) -> None:
        selected, no_selection = self.selected, tr(_NONE_SELECTED_TEXT)
        use_objection = None if selected is None or not selected.on else tr("already on")
        switch_off_objection = None if selected is None or selected.on else tr("already off")
        enable_unless(
            self.use_button,
            no_selection if selected is None else use_objection,
            tr("Correct the axis' readings with it"),
        )
        enable_unless(
            self.switch_off_button,
            no_selection if selected is None else switch_off_objection,
            tr("Do not correct the readings of the axis"),
        )
