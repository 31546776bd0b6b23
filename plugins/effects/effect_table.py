"""Table of the chosen effects, in signal-flow order."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QTableWidgetItem

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable
from rotemina.plugins.effects import mark, tr
from rotemina.plugins.effects.chosen_effects import ChosenEffects
from rotemina.plugins.effects.words import (
    effect_summary,
    effect_title,
    formulation_name,
    stage_name,
)
from rotemina.sim.effects import AttachedEffect

COLUMN_HEADINGS = (mark("On"), mark("Axis"), mark("Stage"), mark("Effect"), mark("Formulation"))
_CHECK_STATES = {True: Qt.CheckState.Checked, False: Qt.CheckState.Unchecked}


class EffectTable(TextTable):
    """Table with one row per effect, each with an on/off check box.

    Signals
    -------
    switched(int, bool) : index of an effect, and whether to switch it on.
    chosen(int) : index of the effect to edit, or −1 if there is none.
    """

    switched = Signal(int, bool)
    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__(
            tr("List of effects"), [tr(column) for column in COLUMN_HEADINGS], row_height=24
        )
        self.horizontalHeader().setStretchLastSection(True)
        self.itemChanged.connect(self._on_change)
        self.currentCellChanged.connect(lambda row, *_: self.chosen.emit(row))

    def show_effects(
        self, effects: ChosenEffects, index: int, theme: Theme, *, all_off: bool
    ) -> None:
        """Show effects with the one at ``index`` chosen, and grey out those that are off.

        With ``all_off``, every effect is shown as off.
        """
        # The style draws the outline of a check box in a darker shade of the window colour. A
        # lighter window colour keeps the outline visible.
        palette = self.palette()
        palette.setColor(QPalette.ColorRole.Window, QColor(theme.quiet).lighter(110))
        self.setPalette(palette)
        self.blockSignals(True)
        self.setRowCount(len(effects))
        for row, attached in enumerate(effects.effects):
            is_active = attached.entry.enabled and not all_off
            for column, text in enumerate(("", *_make_texts(attached))):
                item = QTableWidgetItem(text)
                item.setForeground(QColor(theme.text if is_active else theme.quiet))
                item.setToolTip(make_tooltip(effect_summary(attached.effect)))
                self.setItem(row, column, item)
            check_box = self.item(row, 0)
            check_box.setFlags(check_box.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            check_box.setCheckState(_CHECK_STATES[is_active])
            check_box.setToolTip(make_tooltip(tr("Turn the effect on or off")))
        if 0 <= index < len(effects):
            self.setCurrentCell(index, max(self.currentColumn(), 0))
        self.blockSignals(False)

    def _on_change(self, item: QTableWidgetItem) -> None:
        if item.column() == 0:
            self.switched.emit(item.row(), item.checkState() is Qt.CheckState.Checked)


def _make_texts(attached: AttachedEffect) -> tuple[str, ...]:
    """Return the texts of all columns but the first: axis, stage, effect and formulation."""
    formulation = formulation_name(attached.formulation.name)
    if attached.entry.from_axis is not None:
        text = tr("{formulation}, from {axis}")
        formulation = text.format(
            formulation=formulation, axis=get_axis_label(attached.entry.from_axis)
        )
    return (
        get_axis_label(attached.entry.axis),
        stage_name(attached.effect.stage),
        effect_title(attached.effect),
        formulation,
    )
