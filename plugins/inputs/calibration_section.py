"""Section for the calibration of a device: a measurement, and the settings of each axis."""

from PySide6.QtWidgets import QCheckBox, QFormLayout, QWidget

from rotemina.app.motion.inputs import InputAxisCalibration, InputDeviceView, InputSnapshot
from rotemina.app.widgets.controls import WheelSafeComboBox, enable_unless, make_button
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.calibration_progress import (
    CalibrationProgress,
    describe_axis_calibration,
)
from rotemina.plugins.inputs.measuring_steps import AxisMeasurementView
from rotemina.plugins.inputs.number_field import BoundedNumberField
from rotemina.plugins.inputs.reading_bars import ResponseCurveView
from rotemina.plugins.inputs.words import format_device_name

_MM_PER_M = 1e3


class InputCalibrationSection(Section):
    """Section that measures the axes of a device and edits their settings.

    Changes take effect, and are stored, only when the operator applies them.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Calibration"))
        self._workbench = workbench
        self._progress_by_device: dict[str, CalibrationProgress] = {}
        self._progress: CalibrationProgress | None = None
        self._device: InputDeviceView | None = None
        self.measuring = AxisMeasurementView(workbench)
        self.measuring.measured.connect(self._show_axis)
        self.column.addWidget(self.measuring)
        self.axis = WheelSafeComboBox(tr("Axis"), letters=8)
        self.axis.currentIndexChanged.connect(lambda _: self._show_axis())
        self.column.addWidget(self.axis)
        self.summary = self.add_text()
        self.curve = ResponseCurveView(workbench.theme)
        self.column.addWidget(self.curve)
        self._make_fields()
        self.apply_button = make_button(tr("Apply"), self._apply_draft)
        self.apply_button.setProperty("primary", True)
        self.discard_button = make_button(tr("Discard"), self._discard_draft)
        self.defaults_button = make_button(tr("Defaults"), self._reset_axis)
        self.defaults_button.setToolTip(tr("Reset this axis to the uncalibrated state"))
        self.add_row(self.apply_button, self.discard_button, self.defaults_button, equal=False)

    def _make_fields(self) -> None:
        dead_zone_tooltip = tr(
            "Half width of the range around the centre that counts as centred, raw value"
        )
        self.dead_zone = BoundedNumberField(tr("Dead zone"), "", dead_zone_tooltip, 0.001, 0.5)
        self.expo = BoundedNumberField(
            tr("Expo"), "", tr("Response curve: 0 linear, 1 finest near rest"), 0, 1
        )
        self.travel = BoundedNumberField(
            tr("Travel"),
            "mm",
            tr("Distance of the grip from rest to either end"),
            0.1,
            1000.0,
            optional=True,
        )
        self.inverted = QCheckBox(tr("Inverted"))
        self.inverted.setToolTip(tr("Reverse the sign of the deflection"))
        form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.setVerticalSpacing(4)
        form.addRow(tr("Dead zone"), self.dead_zone)
        form.addRow(tr("Expo"), self.expo)
        form.addRow(tr("Travel, mm"), self.travel)
        form.addRow("", self.inverted)
        self.fields = QWidget()
        self.fields.setLayout(form)
        self.column.addWidget(self.fields)
        self.dead_zone.entered.connect(lambda value: self._change_axis(dead_zone=value))
        self.expo.entered.connect(lambda value: self._change_axis(expo=value))
        self.travel.entered.connect(
            lambda value: self._change_axis(travel_m=None if value is None else value / _MM_PER_M)
        )
        self.inverted.clicked.connect(lambda is_checked: self._change_axis(inverted=is_checked))

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.curve.set_theme(theme)

    def refresh(self, device: InputDeviceView | None, now_s: float) -> None:
        """Show the calibration of a device."""
        self._device = device
        self._use_device(device)
        progress = self._progress
        if device is None or progress is None:
            return
        self.heading.show_text(
            tr("Calibration of {name}").format(name=format_device_name(device.device.identity))
        )
        self.measuring.refresh(progress, device, now_s)
        unchanged_reason = None if progress.is_changed else tr("nothing was changed")
        enable_unless(
            self.apply_button,
            unchanged_reason,
            tr("Use this calibration from now on and store it for the device"),
        )
        enable_unless(self.discard_button, unchanged_reason, tr("Restore the calibration in use"))
        raw = next(
            (axis.raw for axis in device.axes if axis.control == self.axis.currentData()), None
        )
        self.curve.show_curve(self._shown_calibration, raw)

    def receive(self, snapshot: InputSnapshot) -> None:
        """Pass new readings to the calibrations of their devices."""
        for key, readings in snapshot.readings.items():
            if key in self._progress_by_device:
                self._progress_by_device[key].receive(readings)

    def drop_drafts(self) -> None:
        """Discard all drafts, and notify the operator if any of them was changed."""
        changed_names = [
            format_device_name(progress.device.identity)
            for progress in self._progress_by_device.values()
            if progress.is_changed
        ]
        self._progress_by_device.clear()
        self._progress = None
        if changed_names:
            self._workbench.notify(
                Level.WARNING,
                tr("The changed calibration of {names} was not stored.").format(
                    names=tr(" and ").join(changed_names)
                ),
                about=self,
            )

    @property
    def _shown_calibration(self) -> InputAxisCalibration:
        axis = self.axis.currentData()
        return (
            InputAxisCalibration()
            if self._progress is None
            else self._progress.draft.find_axis(str(axis))
        )

    def _use_device(self, device: InputDeviceView | None) -> None:
        """Switch to the draft of a device.

        Create a draft if there is none yet, or if the device has other axes now.
        """
        if device is None:
            if self._progress is not None:
                # Readings after a reconnection would not belong to this measurement.
                self._progress.cancel()
            self._progress = None
            return
        key = device.device.identity.key
        progress = self._progress_by_device.get(key)
        if progress is None or progress.device.axes != device.device.axes:
            progress = self._progress_by_device[key] = CalibrationProgress(device)
        if progress is not self._progress:
            self._progress = progress
            self.axis.blockSignals(True)
            self.axis.clear()
            for axis in device.device.axes:
                self.axis.addItem(axis, axis)
            self.axis.blockSignals(False)
            self._show_axis()

    def _show_axis(self) -> None:
        has_no_axes = self.axis.count() == 0
        for widget in (self.axis, self.curve, self.fields, self.defaults_button):
            widget.setVisible(not has_no_axes)
        if has_no_axes:
            self.summary.setText(tr("The device has no axes: there is nothing to calibrate."))
            return
        calibration = self._shown_calibration
        self.summary.setText(
            tr("The device reports {one}.").format(one=describe_axis_calibration(calibration))
        )
        self.dead_zone.reset(calibration.dead_zone)
        self.expo.reset(calibration.expo)
        self.travel.reset(
            None if calibration.travel_m is None else _MM_PER_M * calibration.travel_m
        )
        self.inverted.setChecked(calibration.inverted)

    def _change_axis(self, **changes: float | bool | None) -> None:
        if self._progress is not None:
            progress, axis = self._progress, str(self.axis.currentData())
            self._workbench.run_request(lambda: progress.change_axis(axis, **changes))
            self._show_axis()

    def _reset_axis(self) -> None:
        if self._progress is not None:
            self._progress.reset_axis(str(self.axis.currentData()))
            self._show_axis()

    def _discard_draft(self) -> None:
        if self._progress is not None:
            self._progress.discard()
            self._show_axis()

    def _apply_draft(self) -> None:
        if self._progress is None:
            return
        progress, identity = self._progress, self._progress.device.identity
        devices = self._workbench.operation.devices
        if self._workbench.run_request(
            lambda: devices.use_calibration(identity.key, progress.draft)
        ):
            progress.calibration_in_use = progress.draft
            self._workbench.notify(
                Level.GOOD,
                tr("The calibration of {name} is stored.").format(
                    name=format_device_name(identity)
                ),
            )
