"""The active effects, in signal order."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QTableWidgetItem

from rotemina.app.display_units import label
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.table import Table
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.chosen_effects import Chain
from rotemina.plugins.effects.words import (
    effect_summary,
    effect_title,
    formulation_name,
    stage_name,
)
from rotemina.sim.effects.attachment import Attached

COLUMNS = (mark("On"), mark("Axis"), mark("Stage"), mark("Effect"), mark("Formulation"))
_CHECKS = {True: Qt.CheckState.Checked, False: Qt.CheckState.Unchecked}


class EffectTable(Table):
    """One row for each effect, with its switch.

    Signals
    -------
    switched(int, bool) : the place of an effect, and whether it is to act.
    chosen(int) : the place of the effect to be tuned, −1 without one.
    """

    switched = Signal(int, bool)
    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__(tr("List of effects"), [tr(column) for column in COLUMNS], row_height=24)
        self.horizontalHeader().setStretchLastSection(True)
        self.itemChanged.connect(self._on_change)
        self.currentCellChanged.connect(lambda row, *_: self.chosen.emit(row))

    def show_chain(self, chain: Chain, place: int, theme: Theme, *, muted: bool) -> None:
        """Show effects with one of them chosen; those that do not act stand back."""
        palette = self.palette()  # the style draws the edge of a switch in a darker shade of this
        palette.setColor(QPalette.ColorRole.Window, QColor(theme.quiet).lighter(110))
        self.setPalette(palette)
        self.blockSignals(True)
        self.setRowCount(len(chain))
        for row, one in enumerate(chain.effects):
            acts = one.asked.enabled and not muted
            for column, text in enumerate(("", *_texts(one))):
                item = QTableWidgetItem(text)
                item.setForeground(QColor(theme.text if acts else theme.quiet))
                item.setToolTip(plain_tip(effect_summary(one.effect)))
                self.setItem(row, column, item)
            switch = self.item(row, 0)
            switch.setFlags(switch.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            switch.setCheckState(_CHECKS[acts])
            switch.setToolTip(plain_tip(tr("Turn the effect on or off")))
        if 0 <= place < len(chain):
            self.setCurrentCell(place, max(self.currentColumn(), 0))
        self.blockSignals(False)

    def _on_change(self, item: QTableWidgetItem) -> None:
        if item.column() == 0:
            self.switched.emit(item.row(), item.checkState() is Qt.CheckState.Checked)


def _texts(one: Attached) -> tuple[str, ...]:
    formulation = formulation_name(one.formulation.name)
    if one.asked.from_axis is not None:
        text = tr("{formulation}, from {axis}")
        formulation = text.format(formulation=formulation, axis=label(one.asked.from_axis))
    return (
        label(one.asked.axis),
        stage_name(one.effect.stage),
        effect_title(one.effect),
        formulation,
    )
