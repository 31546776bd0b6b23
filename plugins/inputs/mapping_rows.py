"""Rows of the mapping: the control of each function."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QGridLayout, QPushButton, QToolButton, QWidget

from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import ActionMapping
from rotemina.app.widgets.controls import allow, named, plain_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.number_field import NumberField
from rotemina.plugins.inputs.profile_edits import Edited
from rotemina.plugins.inputs.words import (
    ACTION_TIPS,
    ACTIONS,
    control_text,
    target_name,
    target_tip,
)

_EXTRA_WIDTH = 46
NOBODY = "–"


class Row(QObject):
    """One thing that a control can do.

    Signals
    -------
    asked() : its control is to be found, or not any more.
    cleared() : nothing is to do it.
    changed(object) : whether it is turned round, or from where on it counts.
    """

    asked = Signal()
    cleared = Signal()
    changed = Signal(object)

    def __init__(self, name: str, tip: str, grid: QGridLayout) -> None:
        super().__init__()
        self.name = name
        self.title = ElidedLabel()
        self.title.show_text(name)
        self.title.setToolTip(plain_tip(name, tip))
        self.control = named(QPushButton(NOBODY), tr("Control of: {name}").format(name=name))
        self.control.setCheckable(True)
        self.control.clicked.connect(lambda _: self.asked.emit())
        self.clear = named(QToolButton(), tr("Clear: {name}").format(name=name))
        self.clear.setText("✕")
        self.clear.clicked.connect(lambda _: self.cleared.emit())
        row = grid.rowCount()
        grid.addWidget(self.title, row, 0)
        grid.addWidget(self.control, row, 1)
        grid.addWidget(self.clear, row, 3)

    def show_edited(self, edited: Edited, finding: str | None) -> None:
        """Show what does it; ``finding``: what to tell while its control is being found."""
        text = self._controls(edited)
        self.control.setChecked(finding is not None)
        self.control.setText(tr("move it …") if finding is not None else text or NOBODY)
        tip = finding or tr("Press this field, then move the control for this action")
        self.control.setToolTip(plain_tip(self.name, text, tip))
        allow(
            self.clear,
            None if text else tr("not mapped"),
            tr("{name}: not mapped").format(name=self.name),
        )

    def _controls(self, edited: Edited) -> str:
        raise NotImplementedError

    def _place_extra(self, grid: QGridLayout, widget: QWidget) -> None:
        widget.setFixedWidth(_EXTRA_WIDTH)
        grid.addWidget(widget, grid.rowCount() - 1, 2)
        policy = widget.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        widget.setSizePolicy(policy)


class TargetRow(Row):
    """An axis that is driven."""

    def __init__(self, target: str, grid: QGridLayout) -> None:
        super().__init__(target_name(target), target_tip(target), grid)
        self.target = target
        self.inverted = QPushButton("±")
        self.inverted.setCheckable(True)
        self.inverted.setAccessibleName(tr("Inverted: {name}").format(name=self.name))
        self.inverted.setToolTip(tr("Inverted: opposite to the calibration"))
        self.inverted.clicked.connect(lambda on: self.changed.emit(on))
        self._place_extra(grid, self.inverted)

    def _controls(self, edited: Edited) -> str:
        mapping = edited.axis(self.target)
        self.inverted.setVisible(mapping is not None)
        self.inverted.setChecked(mapping is not None and mapping.inverted)
        return "" if mapping is None else mapping.control


class ActionRow(Row):
    """An action that is done."""

    def __init__(self, action: Action, grid: QGridLayout) -> None:
        name, tip = ACTIONS[action], ACTION_TIPS[action]
        super().__init__(tr(name), tr(tip), grid)
        self.action = action
        self.at = NumberField(
            tr("Threshold of: {name}").format(name=self.name),
            "%",
            tr("Deflection from which the axis counts as pressed, not between −10 and 10"),
            -100.0,
            100.0,
        )
        self.at.entered.connect(self.changed)
        self._place_extra(grid, self.at)

    def _controls(self, edited: Edited) -> str:
        mappings = edited.actions(self.action)
        at = _threshold(mappings)
        self.at.setVisible(at is not None)
        self.at.show_number(None if at is None else 100.0 * at)
        return control_text({one.control: one.at for one in mappings})


def _threshold(mappings: tuple[ActionMapping, ...]) -> float | None:
    """Return the threshold, where one axis alone does it."""
    return mappings[0].at if len(mappings) == 1 else None
