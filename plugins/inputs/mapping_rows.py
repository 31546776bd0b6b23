"""Rows of the mapping. Each assigns a control of the device to one function."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QGridLayout, QPushButton, QToolButton, QWidget

from rotemina.app.motion.inputs import ActionMapping, OperatorAction
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.text import ElidedLabel
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.number_field import BoundedNumberField
from rotemina.plugins.inputs.profile_edits import ProfileEditor
from rotemina.plugins.inputs.words import (
    ACTION_NAMES,
    ACTION_TIPS,
    describe_target,
    format_controls,
    format_target_name,
)

# The width of the widget for the setting of a row: the inversion or the threshold.
_SETTING_WIDTH_PX = 46
UNMAPPED_TEXT = "–"


class MappingRow(QObject):
    """Row for one function that a control can have.

    Signals
    -------
    find_requested()
        The operator wants to start or cancel the search for the control.
    clear_requested()
        The operator wants no control to have this function.
    setting_changed(object)
        The operator has changed the inversion (bool) or the threshold (float, %).
    """

    find_requested = Signal()
    clear_requested = Signal()
    setting_changed = Signal(object)

    def __init__(self, name: str, explanation: str, grid: QGridLayout) -> None:
        super().__init__()
        self.name = name
        self.title = ElidedLabel()
        self.title.show_text(name)
        self.title.setToolTip(make_tooltip(name, explanation))
        self.control = name_widget(
            QPushButton(UNMAPPED_TEXT), tr("Control of: {name}").format(name=name)
        )
        self.control.setCheckable(True)
        self.control.clicked.connect(lambda _: self.find_requested.emit())
        self.clear = name_widget(QToolButton(), tr("Clear: {name}").format(name=name))
        self.clear.setText("✕")
        self.clear.clicked.connect(lambda _: self.clear_requested.emit())
        row = grid.rowCount()
        grid.addWidget(self.title, row, 0)
        grid.addWidget(self.control, row, 1)
        grid.addWidget(self.clear, row, 3)

    def show_mapping(self, editor: ProfileEditor, hint: str | None) -> None:
        """Show the mapped controls.

        Parameters
        ----------
        editor : ProfileEditor
        hint : str or None
            What the operator should do while the control is being searched for, or None.
        """
        controls_text = self._update_controls(editor)
        self.control.setChecked(hint is not None)
        self.control.setText(
            tr("move it …") if hint is not None else controls_text or UNMAPPED_TEXT
        )
        instruction = hint or tr("Press this field, then move the control for this action")
        self.control.setToolTip(make_tooltip(self.name, controls_text, instruction))
        enable_unless(
            self.clear,
            None if controls_text else tr("not mapped"),
            tr("{name}: not mapped").format(name=self.name),
        )

    def _update_controls(self, editor: ProfileEditor) -> str:
        """Show the setting of the mapping, and return the names of its controls."""
        raise NotImplementedError

    def _place_setting(self, grid: QGridLayout, widget: QWidget) -> None:
        widget.setFixedWidth(_SETTING_WIDTH_PX)
        grid.addWidget(widget, grid.rowCount() - 1, 2)
        policy = widget.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        widget.setSizePolicy(policy)


class TargetMappingRow(MappingRow):
    """Row for a target that a device axis moves: a robot axis, or x, y or z of the stick."""

    def __init__(self, target: str, grid: QGridLayout) -> None:
        super().__init__(format_target_name(target), describe_target(target), grid)
        self.target = target
        self.inverted = QPushButton("±")
        self.inverted.setCheckable(True)
        self.inverted.setAccessibleName(tr("Inverted: {name}").format(name=self.name))
        self.inverted.setToolTip(tr("Inverted: opposite to the calibration"))
        self.inverted.clicked.connect(lambda is_checked: self.setting_changed.emit(is_checked))
        self._place_setting(grid, self.inverted)

    def _update_controls(self, editor: ProfileEditor) -> str:
        mapping = editor.find_axis_mapping(self.target)
        self.inverted.setVisible(mapping is not None)
        self.inverted.setChecked(mapping is not None and mapping.inverted)
        return "" if mapping is None else mapping.control


class ActionMappingRow(MappingRow):
    """Row for an action, with a threshold if an axis triggers it."""

    def __init__(self, action: OperatorAction, grid: QGridLayout) -> None:
        name, explanation = ACTION_NAMES[action], ACTION_TIPS[action]
        super().__init__(tr(name), tr(explanation), grid)
        self.action = action
        self.threshold_field = BoundedNumberField(
            tr("Threshold of: {name}").format(name=self.name),
            "%",
            tr("Deflection from which the axis counts as pressed, not between −10 and 10"),
            -100.0,
            100.0,
        )
        self.threshold_field.entered.connect(self.setting_changed)
        self._place_setting(grid, self.threshold_field)

    def _update_controls(self, editor: ProfileEditor) -> str:
        mappings = editor.find_action_mappings(self.action)
        threshold = _find_threshold(mappings)
        self.threshold_field.setVisible(threshold is not None)
        self.threshold_field.show_number(None if threshold is None else 100.0 * threshold)
        return format_controls({mapping.control: mapping.at for mapping in mappings})


def _find_threshold(mappings: tuple[ActionMapping, ...]) -> float | None:
    """Return the threshold if a single axis triggers the action, or else None."""
    return mappings[0].at if len(mappings) == 1 else None
