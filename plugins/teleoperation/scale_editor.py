"""Editor for the scales of the current mode: distance, speed and force at full deflection."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QLineEdit

from rotemina.app.language import describe_error
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation import CoordinateScale, FrameCoordinate, TeleoperationState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import Section, make_grid
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.teleoperation import tr, wording
from rotemina.plugins.teleoperation.scale_fields import (
    FIELDS,
    find_field_unit,
    format_bounds,
    format_fields,
    with_entered_value,
    with_presets,
)
from rotemina.sim.errors import InputError


class ScaleEditor(Section):
    """Section with the scale of one coordinate. An invalid value reverts to the previous one."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Scales"))
        self._workbench = workbench
        self._teleoperator = workbench.operation.teleoperator
        self._mode = ""
        self._coordinates: dict[str, FrameCoordinate] = {}
        self._shown_scale: tuple[str, str, CoordinateScale] | None = None
        self.choice = WheelSafeComboBox(
            tr("Coordinate whose scale is shown"), tr("Coordinate whose scale is shown below")
        )
        self.choice.currentIndexChanged.connect(lambda _: self._show_scale())
        self.presets = make_button(tr("Presets"), self._use_presets)
        self.add_row(self.choice, self.presets, equal=False)
        self.fields: dict[str, QLineEdit] = {}
        self._units: dict[str, QLabel] = {}
        grid = make_grid(spacing=(8, 4), stretched=1)
        for row, field in enumerate(FIELDS):
            title, unit, edit = make_plain_label(), make_plain_label(), QLineEdit()
            title.setText(field.shown_title)
            title.setBuddy(edit)
            edit.setAlignment(Qt.AlignmentFlag.AlignRight)
            edit.editingFinished.connect(lambda name=field.name: self._use_text(name))
            for widget in (title, edit):
                widget.setToolTip(make_tooltip(field.shown_tip))
            for column, widget in enumerate((title, edit, unit)):
                grid.addWidget(widget, row, column)
            self.fields[field.name], self._units[field.name] = edit, unit
        self.column.addLayout(grid)

    def refresh(self, machine: SessionState, state: TeleoperationState) -> None:
        """Show the scales of the current mode."""
        if state.mode != self._mode:
            self._load_mode(machine, state.mode)
        objection = None if self._coordinates else tr("the positions of the axes are unknown")
        for edit in (*self.fields.values(), self.choice):
            edit.setEnabled(objection is None)
        has_custom_scales = self._mode in self._teleoperator.scales.modes
        objection = objection or (
            None if has_custom_scales else tr("all scales have their presets")
        )
        enable_unless(self.presets, objection, tr("Reset all scales of this mode to their presets"))
        self._show_scale()

    def _load_mode(self, machine: SessionState, mode: str) -> None:
        try:
            frame = self._teleoperator.modes.begin_mode(mode, machine.command)
        except InputError:
            # The overview shows why the mode cannot begin.
            self._coordinates = {}
        else:
            self._mode, self._coordinates = mode, dict(frame.coordinates)
        self._shown_scale = None
        self.choice.blockSignals(True)
        self.choice.clear()
        for name, coordinate in self._coordinates.items():
            self.choice.addItem(wording.name_coordinate(mode, name, coordinate.unit), name)
        self.choice.blockSignals(False)

    def _show_scale(self) -> None:
        """Show the scale in all fields except one that is being edited."""
        name = self.choice.currentData()
        if name not in self._coordinates:
            return
        coordinate = self._coordinates[name]
        scale = self._teleoperator.scales.find_scale(self._mode, coordinate)
        if self._shown_scale == (self._mode, name, scale):
            return
        is_other_coordinate = self._shown_scale is None or self._shown_scale[:2] != (
            self._mode,
            name,
        )
        self._shown_scale = self._mode, name, scale
        field_texts = format_fields(scale, coordinate)
        for field in FIELDS:
            edit, unit = self.fields[field.name], find_field_unit(field, coordinate).unit
            self._units[field.name].setText(unit)
            edit.setAccessibleName(
                tr("{title} of {name} {unit}")
                .format(title=field.shown_title, name=self.choice.currentText(), unit=unit)
                .rstrip()
            )
            edit.setToolTip(make_tooltip(field.shown_tip, format_bounds(field, coordinate)))
            if is_other_coordinate or not (edit.hasFocus() and edit.isModified()):
                edit.setText(field_texts[field.name])

    def _use_text(self, name: str) -> None:
        if self._shown_scale is None or not self.fields[name].isModified():
            return
        mode, coordinate_name, _ = self._shown_scale
        coordinate, scales = self._coordinates[coordinate_name], self._teleoperator.scales
        scale = scales.find_scale(mode, coordinate)
        edit = self.fields[name]
        # Pressing Enter and leaving the field both call this. One error must cause only one notice.
        edit.setModified(False)
        try:
            new_scale = with_entered_value(scale, name, edit.text(), coordinate)
        except InputError as error:
            self._workbench.notify(Level.WARNING, describe_error(error), about=error)
            new_scale = scale
        is_accepted = new_scale is scale or self._workbench.run_request(
            lambda: self._workbench.operation.use_scales(
                scales.with_scale(mode, coordinate_name, new_scale)
            )
        )
        edit.setText(format_fields(new_scale if is_accepted else scale, coordinate)[name])

    def _use_presets(self) -> None:
        scales = with_presets(self._teleoperator.scales, self._mode)
        self._workbench.run_request(lambda: self._workbench.operation.use_scales(scales))
