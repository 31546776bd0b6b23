"""Choice of camera, settings and objective."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QFormLayout, QLabel, QLineEdit, QWidget

from rotemina.app.cameras.feed import FeedState
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, Trigger
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.camera_form import (
    WHOLE,
    CameraTexts,
    bounds_text,
    pixel_types,
    region_text,
    settings_of,
    texts_of,
)
from rotemina.plugins.microscope.picture_view import PictureView

_OPEN = (FeedState.CLOSED, FeedState.LOST)


class CameraSection(Section):
    """Cameras that are there, another one by its address, and the objective."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Camera"))
        self._workbench, self._microscope = workbench, microscope
        self.choice = SteadyChoice(tr("Camera"), letters=6)
        self.address = QLineEdit()
        self.address.setPlaceholderText(tr("e.g. opencv:film.avi"))
        self.address.setAccessibleName(tr("Source and address of another camera"))
        self.address.setToolTip(
            plain_tip(
                tr(
                    "Camera outside the list: source, colon, and a file, folder, stream or "
                    "number, such as opencv:film.avi or sequence:/data/pictures"
                )
            )
        )
        self.open = button(tr("Open"), self._open, tr("Open this camera and close the present one"))
        self.open.setProperty("primary", True)
        self.close_button = button(
            tr("Close"),
            lambda: workbench.ask(microscope.camera.close_and_forget),
            tr("Close the camera"),
        )
        self.objective = SteadyChoice(
            tr("Objective"),
            tr("Objective in use; each has its own calibration. Enter a name to add one"),
            letters=6,
        )
        self.objective.setEditable(True)
        self.objective.setInsertPolicy(SteadyChoice.InsertPolicy.NoInsert)
        edit = self.objective.lineEdit()
        assert edit is not None
        edit.editingFinished.connect(self._choose_objective)
        self.objective.activated.connect(lambda _: self._choose_objective())
        self.column.addWidget(self.choice)
        self.column.addWidget(self.address)
        self.add_row(self.open, self.close_button)
        title = QLabel(tr("Objective"))
        title.setBuddy(self.objective)
        self.add_row(title, self.objective)
        self.said = self.add_text()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the available cameras and the one in use."""
        listed = [(spoken(one.name), one.key) for one in status.cameras]
        _offer(self.choice, listed, None if status.camera is None else status.camera.key)
        _offer(self.objective, [(name, name) for name in status.objectives], None)
        edit = self.objective.lineEdit()
        assert edit is not None
        if not edit.hasFocus() and edit.text() != status.objective:
            edit.setText(status.objective)
        nothing = not listed and not self.address.text().strip()
        why = tr("no camera is selected or entered") if nothing else None
        allow(self.open, why, tr("Open this camera and close the present one"))
        closed = tr("no camera is open") if status.feed.state in _OPEN else None
        allow(self.close_button, closed, tr("Close the camera"))
        problems = [f"{source}: {spoken(why)}" for source, why in status.camera_problems.items()]
        show_text(self.said, "\n".join([one for one in (spoken(status.truth), *problems) if one]))

    def _open(self) -> None:
        source, colon, address = self.address.text().strip().partition(":")
        if colon:
            self._workbench.ask(lambda: self._microscope.camera.open_address(source, address))
        elif self.choice.currentData() is not None:
            self._workbench.ask(lambda: self._microscope.camera.open(self.choice.currentData()))

    def _choose_objective(self) -> None:
        name = self.objective.currentText().strip()
        if name and name != self._microscope.status.objective:
            self._workbench.ask(lambda: self._microscope.choose_objective(name))


class SettingsSection(Section):
    """Exposure, gain, region, kind of pixels and trigger, as far as the camera has them."""

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(tr("Camera settings"))
        self._workbench, self._microscope, self._view = workbench, microscope, view
        self._shown: CameraSettings | None = None
        self._can: CameraDescription | None = None
        self.form = QWidget()
        rows = QFormLayout(self.form)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        rows.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.exposure, self.gain, self.rate, self.region = (QLineEdit() for _ in range(4))
        self.pixel_type, self.trigger = (
            SteadyChoice(tr("Pixel type"), letters=6),
            SteadyChoice(tr("Trigger"), letters=6),
        )
        self.repeat = QCheckBox(tr("Loop at the end"))
        self.repeat.setToolTip(plain_tip(tr("Repeat a file or a sequence of pictures")))
        for text, field in (
            (tr("Exposure [ms]"), self.exposure),
            (tr("Gain"), self.gain),
            (tr("Rate [Hz]"), self.rate),
            (tr("Region [px]"), self.region),
            (tr("Pixels"), self.pixel_type),
            (tr("Trigger"), self.trigger),
        ):
            field.setAccessibleName(text)
            field.setToolTip(
                plain_tip(tr("{text}; open the camera to see its limits").format(text=text))
            )
            field.setMinimumWidth(60)
            rows.addRow(text, field)
        rows.addRow(self.repeat)
        self.column.addWidget(self.form)
        self.apply = button(
            tr("Set"), self._apply, tr("Apply these settings; refusals appear below")
        )
        self.cut = button(
            tr("Use visible region"), self._cut, tr("Read out only the visible region")
        )
        self.add_row(self.apply, self.cut)
        self.shoot = button(
            tr("Take picture"),
            lambda: workbench.ask(microscope.camera.trigger),
            tr("Trigger the camera once"),
        )
        self.column.addWidget(self.shoot)
        self.problem = self.add_text()
        self.problem.setProperty("bad", True)
        for field in (self.exposure, self.gain, self.rate, self.region):
            field.returnPressed.connect(self._apply)

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show what is in force, unless someone is typing."""
        feed = status.feed
        can = feed.description
        why = tr("no camera is open") if can is None else None
        allow(self.form, why, "")
        allow(self.apply, why, tr("Apply these settings; refusals appear below"))
        no_frame = why or (tr("there is no picture") if feed.frame is None else None)
        allow(
            self.cut,
            no_frame,
            tr("Read out only the visible region: smaller pictures at a higher rate"),
        )
        waits = why or (
            None if feed.settings.trigger is Trigger.SOFTWARE else tr("the camera is free-running")
        )
        allow(self.shoot, waits, tr("Trigger the camera once"))
        show_text(self.problem, feed.problem)
        if can is None:
            self._can = self._shown = None
        elif can != self._can or (feed.settings != self._shown and not self._typing()):
            self._can, self._shown = can, feed.settings
            self._fill(can, texts_of(feed.settings))

    def _typing(self) -> bool:
        return any(one.hasFocus() for one in (self.exposure, self.gain, self.rate, self.region))

    def _fill(self, can: CameraDescription, texts: CameraTexts) -> None:
        for field, text, bounds, scale, unit in (
            (self.exposure, texts.exposure, can.exposure_s, 1e3, "ms"),
            (self.gain, texts.gain, can.gain, 1.0, ""),
            (self.rate, texts.rate, can.rate_hz, 1.0, "Hz"),
        ):
            field.setText(text)
            field.setEnabled(bounds is not None)
            field.setPlaceholderText(tr("unchanged") if bounds is not None else tr("cannot be set"))
            field.setToolTip(plain_tip(bounds_text(bounds, scale, unit)))
        self.region.setText(texts.region)
        self.region.setToolTip(
            plain_tip(
                tr(
                    "{whole}, or first column, first row, width and height of the sensor's "
                    "{width} × {height} px"
                ).format(whole=tr(WHOLE), width=can.width, height=can.height)
            )
        )
        _offer(
            self.pixel_type,
            [(spoken(one), one.value) for one in pixel_types(can)],
            texts.pixel_type,
        )
        _offer(self.trigger, [(spoken(one), one.value) for one in can.triggers], texts.trigger)
        self.repeat.setChecked(texts.repeat)

    def _apply(self) -> None:
        texts = CameraTexts(
            self.exposure.text(),
            self.gain.text(),
            self.rate.text(),
            self.region.text(),
            self.pixel_type.currentData() or "",
            self.trigger.currentData() or Trigger.FREE.value,
            self.repeat.isChecked(),
        )
        self._workbench.ask(lambda: self._microscope.camera.configure(settings_of(texts)))

    def _cut(self) -> None:
        region = self._view.region_in_sight()
        if region is not None:
            self.region.setText(region_text(region))
            self._apply()


def _offer(choice: SteadyChoice, items: list[tuple[str, str]], chosen: str | None) -> None:
    """Offer items, a text and its value each; what was chosen stays, if it is still there."""
    now = [(choice.itemText(row), choice.itemData(row)) for row in range(choice.count())]
    if now != items:
        kept = choice.currentData()
        choice.blockSignals(True)
        choice.clear()
        for text, value in items:
            choice.addItem(text, value)
        choice.setCurrentIndex(max(choice.findData(kept), 0) if items else -1)
        choice.blockSignals(False)
        if chosen:
            choice.setCurrentIndex(choice.findData(chosen))
