"""The stored calibrations, and the switch for the one in use."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.calibration.store import Stored
from rotemina.app.widgets.controls import allow, plain_tip
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.calibration import mark, tr
from rotemina.plugins.calibration.words import STORED_HEAD, shown, stored_row

_NONE = mark("select a calibration in the table")


class StoredView(QWidget):
    """Table and buttons.

    Signals
    -------
    switched(str, object) : an axis shall use the calibration of this path, or None.
    """

    switched = Signal(str, object)

    def __init__(self) -> None:
        super().__init__()
        self.stored: tuple[Stored, ...] = ()
        self.table = Table(tr("Stored calibrations"), shown(STORED_HEAD))
        self.table.itemSelectionChanged.connect(self._allow)
        self.on, self.off = QPushButton(tr("Use")), QPushButton(tr("Switch off"))
        self.on.clicked.connect(lambda: self._switch(on=True))
        self.off.clicked.connect(lambda: self._switch(on=False))
        in_column((self.table, 1), in_row(1, self.on, self.off), on=self, margins=0, spacing=4)
        self._allow()

    @property
    def chosen(self) -> Stored | None:
        """The calibration of the chosen row."""
        rows = {index.row() for index in self.table.selectedIndexes()}
        return self.stored[rows.pop()] if rows else None

    def show_stored(self, stored: tuple[Stored, ...]) -> None:
        """Show the stored calibrations, and keep the selection."""
        chosen = self.chosen
        self.table.clearSelection()
        self.stored = stored
        self.table.show_rows(tuple(map(stored_row, stored)))
        for row, one in enumerate(stored):
            self.table.item(row, 0).setToolTip(plain_tip(str(one.path), one.calibration.name))
            if chosen is not None and one.path == chosen.path:
                self.table.selectRow(row)
        self._allow()

    def _switch(self, *, on: bool) -> None:
        chosen = self.chosen
        if chosen is not None:
            path: Path | None = chosen.path if on else None
            self.switched.emit(chosen.calibration.axis, path)

    def _allow(self) -> None:
        chosen, none = self.chosen, tr(_NONE)
        already = None if chosen is None or not chosen.on else tr("already on")
        idle = None if chosen is None or chosen.on else tr("already off")
        allow(
            self.on, none if chosen is None else already, tr("Correct the axis' readings with it")
        )
        allow(
            self.off,
            none if chosen is None else idle,
            tr("Do not correct the readings of the axis"),
        )
