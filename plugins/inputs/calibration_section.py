"""Calibration of one device: measurement, then curve, direction and travel of each axis."""

from PySide6.QtWidgets import QCheckBox, QFormLayout, QWidget

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration
from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.motion.teleoperation.input_devices import InputSnapshot
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.calibration_progress import Calibrating, summary
from rotemina.plugins.inputs.measuring_steps import Measuring
from rotemina.plugins.inputs.number_field import NumberField
from rotemina.plugins.inputs.reading_bars import Curve
from rotemina.plugins.inputs.words import device_name

_MM = 1e3


class CalibrationSection(Section):
    """Measuring, and the settings of each axis; used and kept when someone says so."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Calibration"))
        self._workbench = workbench
        self._all: dict[str, Calibrating] = {}
        self._now: Calibrating | None = None
        self._device: DeviceView | None = None
        self.measuring = Measuring(workbench)
        self.measuring.measured.connect(self._show_axis)
        self.column.addWidget(self.measuring)
        self.axis = SteadyChoice(tr("Axis"), letters=8)
        self.axis.currentIndexChanged.connect(lambda _: self._show_axis())
        self.column.addWidget(self.axis)
        self.summary = self.add_text()
        self.curve = Curve(workbench.theme)
        self.column.addWidget(self.curve)
        self._make_fields()
        self.keep = button(tr("Apply"), self._keep)
        self.keep.setProperty("primary", True)
        self.discard = button(tr("Discard"), self._discard)
        self.defaults = button(tr("Defaults"), self._forget)
        self.defaults.setToolTip(tr("Reset this axis to the uncalibrated state"))
        self.add_row(self.keep, self.discard, self.defaults, equal=False)

    def _make_fields(self) -> None:
        about = tr("Half width of the range around the centre that counts as centred, raw value")
        self.dead_zone = NumberField(tr("Dead zone"), "", about, 0.001, 0.5)
        self.expo = NumberField(
            tr("Expo"), "", tr("Response curve: 0 linear, 1 finest near rest"), 0, 1
        )
        self.travel = NumberField(
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
        self.dead_zone.entered.connect(lambda value: self._change(dead_zone=value))
        self.expo.entered.connect(lambda value: self._change(expo=value))
        self.travel.entered.connect(
            lambda value: self._change(travel_m=None if value is None else value / _MM)
        )
        self.inverted.clicked.connect(lambda on: self._change(inverted=on))

    # --- what is shown ----------------------------------------------------------------------------

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self.curve.set_theme(theme)

    def refresh(self, device: DeviceView | None, now_s: float) -> None:
        """Show the calibration of a device."""
        self._device = device
        self._use(device)
        now = self._now
        if device is None or now is None:
            return
        self.heading.show_text(
            tr("Calibration of {name}").format(name=device_name(device.device.identity))
        )
        self.measuring.refresh(now, device, now_s)
        unchanged = None if now.changed else tr("nothing was changed")
        allow(
            self.keep, unchanged, tr("Use this calibration from now on and store it for the device")
        )
        allow(self.discard, unchanged, tr("Restore the calibration in use"))
        raw = next((a.raw for a in device.axes if a.control == self.axis.currentData()), None)
        self.curve.show_curve(self._shown, raw)

    def receive(self, snapshot: InputSnapshot) -> None:
        """Take in what the devices have said."""
        for key, readings in snapshot.readings.items():
            if key in self._all:
                self._all[key].receive(readings)

    def leave(self) -> None:
        """Forget what was not kept; someone is told of it."""
        lost = [device_name(one.device.identity) for one in self._all.values() if one.changed]
        self._all.clear()
        self._now = None
        if lost:
            self._workbench.notify(
                Level.WARNING,
                tr("The changed calibration of {names} was not stored.").format(
                    names=tr(" and ").join(lost)
                ),
                about=self,
            )

    @property
    def _shown(self) -> AxisCalibration:
        axis = self.axis.currentData()
        return AxisCalibration() if self._now is None else self._now.draft.axis(str(axis))

    def _use(self, device: DeviceView | None) -> None:
        """Have a draft for a device, a new one if it has come back as another."""
        if device is None:
            if self._now is not None:
                self._now.cancel()  # what it says now is not what was being measured
            self._now = None
            return
        key = device.device.identity.key
        one = self._all.get(key)
        if one is None or one.device.axes != device.device.axes:
            one = self._all[key] = Calibrating(device)
        if one is not self._now:
            self._now = one
            self.axis.blockSignals(True)
            self.axis.clear()
            for axis in device.device.axes:
                self.axis.addItem(axis, axis)
            self.axis.blockSignals(False)
            self._show_axis()

    def _show_axis(self) -> None:
        none = self.axis.count() == 0
        for widget in (self.axis, self.curve, self.fields, self.defaults):
            widget.setVisible(not none)
        if none:
            self.summary.setText(tr("The device has no axes: there is nothing to calibrate."))
            return
        one = self._shown
        self.summary.setText(tr("The device reports {one}.").format(one=summary(one)))
        self.dead_zone.reset(one.dead_zone)
        self.expo.reset(one.expo)
        self.travel.reset(None if one.travel_m is None else _MM * one.travel_m)
        self.inverted.setChecked(one.inverted)

    # --- changes ----------------------------------------------------------------------------------

    def _change(self, **changes: float | bool | None) -> None:
        if self._now is not None:
            now, axis = self._now, str(self.axis.currentData())
            self._workbench.ask(lambda: now.change(axis, **changes))
            self._show_axis()

    def _forget(self) -> None:
        if self._now is not None:
            self._now.forget(str(self.axis.currentData()))
            self._show_axis()

    def _discard(self) -> None:
        if self._now is not None:
            self._now.discard()
            self._show_axis()

    def _keep(self) -> None:
        if self._now is None:
            return
        now, identity = self._now, self._now.device.identity
        devices = self._workbench.operation.devices
        if self._workbench.ask(lambda: devices.calibrate(identity.key, now.draft)):
            now.kept = now.draft
            self._workbench.notify(
                Level.GOOD,
                tr("The calibration of {name} is stored.").format(name=device_name(identity)),
            )
