"""Choice of camera and objective, and the settings of the camera."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QFormLayout, QLabel, QLineEdit, QWidget

from rotemina.app.cameras import FeedState
from rotemina.app.language import translate_message
from rotemina.app.microscope import Microscope, MicroscopeStatus
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Workbench
from rotemina.drivers.cameras import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
)
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.camera_form import (
    WHOLE_SENSOR,
    CameraTexts,
    format_bounds,
    format_region,
    list_pixel_types,
    to_camera_settings,
    to_camera_texts,
)
from rotemina.plugins.microscope.picture_view import PictureView

_CLOSED_STATES = (FeedState.CLOSED, FeedState.LOST)


class CameraSection(Section):
    """Section to open a camera, from the list or by its address, and to choose the objective."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Camera"))
        self._workbench, self._microscope = workbench, microscope
        self.choice = WheelSafeComboBox(tr("Camera"), letters=6)
        self.address = QLineEdit()
        self.address.setPlaceholderText(tr("e.g. opencv:film.avi"))
        self.address.setAccessibleName(tr("Source and address of another camera"))
        self.address.setToolTip(
            make_tooltip(
                tr(
                    "Camera outside the list: source, colon, and a file, folder, stream or "
                    "number, such as opencv:film.avi or sequence:/data/pictures"
                )
            )
        )
        self.open = make_button(
            tr("Open"), self._open, tr("Open this camera and close the present one")
        )
        self.open.setProperty("primary", True)
        self.close_button = make_button(
            tr("Close"),
            lambda: workbench.run_request(microscope.camera.close_and_forget),
            tr("Close the camera"),
        )
        self.objective = WheelSafeComboBox(
            tr("Objective"),
            tr("Objective in use; each has its own calibration. Enter a name to add one"),
            letters=6,
        )
        self.objective.setEditable(True)
        self.objective.setInsertPolicy(WheelSafeComboBox.InsertPolicy.NoInsert)
        line_edit = self.objective.lineEdit()
        assert line_edit is not None
        line_edit.editingFinished.connect(self._choose_objective)
        self.objective.activated.connect(lambda _: self._choose_objective())
        self.column.addWidget(self.choice)
        self.column.addWidget(self.address)
        self.add_row(self.open, self.close_button)
        title = QLabel(tr("Objective"))
        title.setBuddy(self.objective)
        self.add_row(title, self.objective)
        self.status_label = self.add_text()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the available cameras and the objective in use."""
        camera_items = [(translate_message(camera.name), camera.key) for camera in status.cameras]
        # The open camera is selected only when the list changes, so that the operator can select
        # another one.
        if _set_items(self.choice, camera_items) and status.camera is not None:
            self.choice.select(status.camera.key)
        _set_items(self.objective, [(name, name) for name in status.objectives])
        line_edit = self.objective.lineEdit()
        assert line_edit is not None
        if not line_edit.hasFocus() and line_edit.text() != status.objective:
            line_edit.setText(status.objective)
        is_empty = not camera_items and not self.address.text().strip()
        objection = tr("no camera is selected or entered") if is_empty else None
        enable_unless(self.open, objection, tr("Open this camera and close the present one"))
        closed_objection = tr("no camera is open") if status.feed.state in _CLOSED_STATES else None
        enable_unless(self.close_button, closed_objection, tr("Close the camera"))
        problems = [
            f"{source}: {translate_message(reason)}"
            for source, reason in status.camera_problems.items()
        ]
        show_or_hide_text(
            self.status_label,
            "\n".join(
                [line for line in (translate_message(status.simulation_problem), *problems) if line]
            ),
        )

    def _open(self) -> None:
        source, colon, address = self.address.text().strip().partition(":")
        if colon:
            self._workbench.run_request(
                lambda: self._microscope.camera.open_address(source, address)
            )
        elif self.choice.currentData() is not None:
            self._workbench.run_request(
                lambda: self._microscope.camera.open(self.choice.currentData())
            )

    def _choose_objective(self) -> None:
        name = self.objective.currentText().strip()
        if name and name != self._microscope.status.objective:
            self._workbench.run_request(lambda: self._microscope.choose_objective(name))


class CameraSettingsSection(Section):
    """Section with exposure, gain, region, pixel type and trigger.

    Fields that the camera does not support are disabled.
    """

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(tr("Camera settings"))
        self._workbench, self._microscope, self._view = workbench, microscope, view
        self._shown_settings: CameraSettings | None = None
        self._description: CameraDescription | None = None
        self.form = QWidget()
        rows = QFormLayout(self.form)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        rows.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.exposure, self.gain, self.rate, self.region = (QLineEdit() for _ in range(4))
        self.pixel_type, self.trigger = (
            WheelSafeComboBox(tr("Pixel type"), letters=6),
            WheelSafeComboBox(tr("Trigger"), letters=6),
        )
        self.repeat = QCheckBox(tr("Loop at the end"))
        self.repeat.setToolTip(make_tooltip(tr("Repeat a file or a sequence of pictures")))
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
                make_tooltip(tr("{text}; open the camera to see its limits").format(text=text))
            )
            field.setMinimumWidth(60)
            rows.addRow(text, field)
        rows.addRow(self.repeat)
        self.column.addWidget(self.form)
        self.apply = make_button(
            tr("Set"), self._apply, tr("Apply these settings; refusals appear below")
        )
        self.crop_button = make_button(
            tr("Use visible region"), self._crop_to_view, tr("Read out only the visible region")
        )
        self.add_row(self.apply, self.crop_button)
        self.trigger_button = make_button(
            tr("Take picture"),
            lambda: workbench.run_request(microscope.camera.trigger),
            tr("Trigger the camera once"),
        )
        self.column.addWidget(self.trigger_button)
        self.problem = self.add_text()
        self.problem.setProperty("bad", True)
        for field in (self.exposure, self.gain, self.rate, self.region):
            field.returnPressed.connect(self._apply)

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the current settings, unless the operator is typing."""
        feed = status.feed
        description = feed.description
        objection = tr("no camera is open") if description is None else None
        enable_unless(self.form, objection, "")
        enable_unless(self.apply, objection, tr("Apply these settings; refusals appear below"))
        frame_objection = objection or (tr("there is no picture") if feed.frame is None else None)
        enable_unless(
            self.crop_button,
            frame_objection,
            tr("Read out only the visible region: smaller pictures at a higher rate"),
        )
        trigger_objection = objection or (
            None
            if feed.settings.trigger is CameraTrigger.SOFTWARE
            else tr("the camera is free-running")
        )
        enable_unless(self.trigger_button, trigger_objection, tr("Trigger the camera once"))
        show_or_hide_text(self.problem, feed.problem)
        if description is None:
            self._description = self._shown_settings = None
        elif description != self._description or (
            feed.settings != self._shown_settings and not self._is_typing()
        ):
            self._description, self._shown_settings = description, feed.settings
            self._fill_fields(description, to_camera_texts(feed.settings))

    def _is_typing(self) -> bool:
        return any(field.hasFocus() for field in (self.exposure, self.gain, self.rate, self.region))

    def _fill_fields(self, description: CameraDescription, texts: CameraTexts) -> None:
        for field, text, bounds, scale, unit in (
            (self.exposure, texts.exposure, description.exposure_s, 1e3, "ms"),
            (self.gain, texts.gain, description.gain, 1.0, ""),
            (self.rate, texts.rate, description.rate_hz, 1.0, "Hz"),
        ):
            field.setText(text)
            field.setEnabled(bounds is not None)
            field.setPlaceholderText(tr("unchanged") if bounds is not None else tr("cannot be set"))
            field.setToolTip(make_tooltip(format_bounds(bounds, scale, unit)))
        self.region.setText(texts.region)
        self.region.setToolTip(
            make_tooltip(
                tr(
                    "{whole}, or first column, first row, width and height of the sensor's "
                    "{width} × {height} px"
                ).format(whole=tr(WHOLE_SENSOR), width=description.width, height=description.height)
            )
        )
        pixel_types = list_pixel_types(description)
        _set_items(self.pixel_type, [(translate_message(kind), kind.value) for kind in pixel_types])
        # Settings without a pixel type mean the camera's first one.
        self.pixel_type.select(texts.pixel_type or pixel_types[0].value)
        _set_items(
            self.trigger,
            [(translate_message(trigger), trigger.value) for trigger in description.triggers],
        )
        self.trigger.select(texts.trigger)
        self.repeat.setChecked(texts.repeat)

    def _apply(self) -> None:
        texts = CameraTexts(
            self.exposure.text(),
            self.gain.text(),
            self.rate.text(),
            self.region.text(),
            self.pixel_type.currentData() or "",
            self.trigger.currentData() or CameraTrigger.FREE.value,
            self.repeat.isChecked(),
        )
        self._workbench.run_request(
            lambda: self._microscope.camera.configure(to_camera_settings(texts))
        )

    def _crop_to_view(self) -> None:
        region = self._view.find_visible_region()
        if region is not None:
            self.region.setText(format_region(region))
            self._apply()


def _set_items(choice: WheelSafeComboBox, items: list[tuple[str, str]]) -> bool:
    """Replace the items (text, value) if they have changed, and return whether they have.

    The selection is kept where possible.
    """
    current_items = [(choice.itemText(row), choice.itemData(row)) for row in range(choice.count())]
    if current_items == items:
        return False
    selected = choice.currentData()
    choice.blockSignals(True)
    choice.clear()
    for text, value in items:
        choice.addItem(text, value)
    choice.setCurrentIndex(max(choice.findData(selected), 0) if items else -1)
    choice.blockSignals(False)
    return True
