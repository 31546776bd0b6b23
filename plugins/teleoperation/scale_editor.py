"""Scales of the present mode: distance, speed and force at full deflection."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QLineEdit

from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.frames import Coordinate
from rotemina.app.motion.teleoperation.scales import Scale
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.shell.engine_words import error_text
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_grid
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.teleoperation import tr, wording
from rotemina.plugins.teleoperation.scale_fields import (
    FIELDS,
    bounds_text,
    changed,
    shown,
    texts,
    without,
)
from rotemina.sim.errors import InputError


class ScaleEditor(Section):
    """Fields for one coordinate at a time; a value that is refused is put back."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Scales"))
        self._workbench = workbench
        self._steered = workbench.operation.teleoperator
        self._mode = ""
        self._coordinates: dict[str, Coordinate] = {}
        self._shown: tuple[str, str, Scale] | None = None
        self.choice = SteadyChoice(
            tr("Coordinate whose scale is shown"), tr("Coordinate whose scale is shown below")
        )
        self.choice.currentIndexChanged.connect(lambda _: self._show())
        self.presets = button(tr("Presets"), self._use_presets)
        self.add_row(self.choice, self.presets, equal=False)
        self.fields: dict[str, QLineEdit] = {}
        self._units: dict[str, QLabel] = {}
        grid = in_grid(spacing=(8, 4), stretched=1)
        for number, field in enumerate(FIELDS):
            title, unit, edit = plain_text(), plain_text(), QLineEdit()
            title.setText(field.shown_title)
            title.setBuddy(edit)
            edit.setAlignment(Qt.AlignmentFlag.AlignRight)
            edit.editingFinished.connect(lambda name=field.name: self._commit(name))
            for widget in (title, edit):
                widget.setToolTip(plain_tip(field.shown_tip))
            for place, widget in enumerate((title, edit, unit)):
                grid.addWidget(widget, number, place)
            self.fields[field.name], self._units[field.name] = edit, unit
        self.column.addLayout(grid)

    def refresh(self, machine: SessionState, state: TeleoperationState) -> None:
        """Show the scales of the present mode, as they are now."""
        if state.mode != self._mode:
            self._begin(machine, state.mode)
        why = None if self._coordinates else tr("the positions of the axes are unknown")
        for edit in (*self.fields.values(), self.choice):
            edit.setEnabled(why is None)
        kept = self._mode in self._steered.scales.modes
        why = why or (None if kept else tr("all scales have their presets"))
        allow(self.presets, why, tr("Reset all scales of this mode to their presets"))
        self._show()

    def _begin(self, machine: SessionState, mode: str) -> None:
        """Offer the coordinates of a mode, once the axes' positions are known."""
        try:
            frame = self._steered.modes.begin(mode, machine.command)
        except InputError:  # the head says why the mode cannot begin
            self._coordinates = {}
        else:
            self._mode, self._coordinates = mode, dict(frame.coordinates)
        self._shown = None
        self.choice.blockSignals(True)
        self.choice.clear()
        for name, coordinate in self._coordinates.items():
            self.choice.addItem(wording.coordinate_name(mode, name, coordinate.unit), name)
        self.choice.blockSignals(False)

    def _show(self) -> None:
        """Write the scale into the fields, but for the one in which someone types."""
        name = self.choice.currentData()
        if name not in self._coordinates:
            return
        coordinate = self._coordinates[name]
        scale = self._steered.scales.of(self._mode, coordinate)
        if self._shown == (self._mode, name, scale):
            return
        elsewhere = self._shown is None or self._shown[:2] != (self._mode, name)
        self._shown = self._mode, name, scale
        told = texts(scale, coordinate)
        for field in FIELDS:
            edit, unit = self.fields[field.name], shown(field, coordinate).unit
            self._units[field.name].setText(unit)
            edit.setAccessibleName(
                tr("{title} of {name} {unit}")
                .format(title=field.shown_title, name=self.choice.currentText(), unit=unit)
                .rstrip()
            )
            edit.setToolTip(plain_tip(field.shown_tip, bounds_text(field, coordinate)))
            if elsewhere or not (edit.hasFocus() and edit.isModified()):
                edit.setText(told[field.name])

    def _commit(self, name: str) -> None:
        """Use what was typed, or put back what is in use."""
        if self._shown is None or not self.fields[name].isModified():
            return
        mode, of, _ = self._shown
        coordinate, scales = self._coordinates[of], self._steered.scales
        scale = scales.of(mode, coordinate)
        edit = self.fields[name]
        edit.setModified(False)  # it is left after its text was entered: one slip, one notice
        try:
            made = changed(scale, name, edit.text(), coordinate)
        except InputError as error:
            self._workbench.notify(Level.WARNING, error_text(error), about=error)
            made = scale
        taken = made is scale or self._workbench.ask(
            lambda: self._workbench.operation.use_scales(scales.with_scale(mode, of, made))
        )
        edit.setText(texts(made if taken else scale, coordinate)[name])

    def _use_presets(self) -> None:
        scales = without(self._steered.scales, self._mode)
        self._workbench.ask(lambda: self._workbench.operation.use_scales(scales))
