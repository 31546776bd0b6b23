"""The Input devices panel: the list of devices, their live readings, and the set-up."""

from collections import deque
from collections.abc import Callable
from enum import StrEnum

from PySide6.QtCore import QTimer
from PySide6.QtGui import QHideEvent
from PySide6.QtWidgets import QPushButton, QTabBar, QWidget

from rotemina.app.language import marked
from rotemina.app.motion.inputs import InputDeviceView, InputDisplayState, InputSnapshot
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    STALE_AGE_S,
    Panel,
    PanelArea,
)
from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, StateTone, Workbench, set_tone
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.calibration_section import InputCalibrationSection
from rotemina.plugins.inputs.device_list import DeviceList, ProblemList
from rotemina.plugins.inputs.live_readings import LiveReadingsSection
from rotemina.plugins.inputs.mapping_section import MappingSection
from rotemina.plugins.inputs.profile_section import ProfileSection
from rotemina.plugins.inputs.profiles import ProfileChoice
from rotemina.plugins.inputs.words import (
    SET_UP_BANNER,
    describe_control,
    list_device_entries,
    list_problems,
)

# The number of snapshots that are queued between two frames at most. It suffices for some seconds.
_MAX_QUEUED_SNAPSHOTS = 2000


class SetUpPage(StrEnum):
    """Page of the set-up. The values are the titles of the tabs."""

    DEVICES = mark("Devices")
    MAPPING = mark("Mapping")
    CALIBRATION = mark("Calibration")


class InputsPanel(Panel):
    """Panel with the devices, their live readings and the profile, and pages for the set-up."""

    title = marked("panels", "Input devices")
    area = PanelArea.RIGHT
    order = 25
    help_page = "input-mapping.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._devices = workbench.operation.devices
        self._snapshots: deque[InputSnapshot] = deque(maxlen=_MAX_QUEUED_SNAPSHOTS)
        self._stop_listening: Callable[[], None] | None = None
        axes = tuple(workbench.robot.axes)
        self.profiles = ProfileChoice(self._devices, workbench.settings, axes)
        problem = self.profiles.use_last_profile()
        if problem is not None:
            # The window can show the notice only once the event loop is running.
            QTimer.singleShot(0, self, lambda: workbench.notify(Level.WARNING, problem, about=self))
        self._make_parts()
        self._lay_out()
        self.follow(self._refresh)
        workbench.theme_changed.connect(self._use_theme)
        workbench.closing.connect(self.leave_set_up)
        self.refresh()

    def _make_parts(self) -> None:
        workbench = self.workbench
        self.headline = make_plain_label(wrap=True)
        self.banner = make_plain_label(wrap=True)
        self.banner.setText(tr(SET_UP_BANNER))
        set_tone(self.banner, StateTone.WARNING)
        self.set_up = QPushButton(tr("Set up …"))
        self.set_up.setCheckable(True)
        self.set_up.setToolTip(tr("Map and calibrate; meanwhile only stops are sent"))
        self.set_up.toggled.connect(self._toggle_set_up)
        self.tabs = name_widget(QTabBar(), tr("Section of the set-up"))
        self.tabs.setDrawBase(False)
        for page in SetUpPage:
            self.tabs.addTab(tr(page))
        self.tabs.currentChanged.connect(lambda _: self._on_page_changed())
        self.problem_list = ProblemList()
        self.device_list = DeviceList()
        self.live = LiveReadingsSection(workbench.theme)
        self.profile = ProfileSection(workbench, self.profiles)
        # These are created when the set-up is first opened, because most sessions never need them.
        self.mapping: MappingSection | None = None
        self.calibration: InputCalibrationSection | None = None

    def _lay_out(self) -> None:
        row = make_row((self.headline, 1), self.set_up, spacing=8)
        self._header = make_column(self.banner, row, self.tabs, margins=(10, 8, 10, 4), spacing=6)
        content = QWidget()
        parts = self.device_list, self.live, self.problem_list, self.profile
        self._column = make_column(*parts, 1, on=content, margins=(10, 0, 10, 8), spacing=4)
        make_column(
            self._header,
            (make_scroll_area(content, min_width=320), 1),
            on=self,
            margins=0,
            spacing=0,
        )
        self._show_page(None)

    def _make_set_up_sections(self) -> tuple[MappingSection, InputCalibrationSection]:
        """Return the mapping and the calibration section, and create them at the first call."""
        if self.mapping is None or self.calibration is None:
            self.mapping = MappingSection(self.workbench, self.profiles)
            self.calibration = InputCalibrationSection(self.workbench)
            self._header.addWidget(self.mapping.message)
            index = self._column.indexOf(self.profile)
            self._column.insertWidget(index, self.calibration)
            self._column.insertWidget(index, self.mapping)
        return self.mapping, self.calibration

    def refresh(self) -> None:
        """Show the latest state of the devices."""
        view, now_s = self._devices.view, self.workbench.operation.clock()
        hub = self._devices.hub
        problems = list_problems(view, hub)
        self.headline.setText(describe_control(view, len(problems)))
        self.problem_list.show_problems(problems)
        self.device_list.show_entries(list_device_entries(view, hub))
        device = next(
            (
                candidate
                for candidate in view.devices
                if candidate.device.identity.key == self.device_list.device_key
            ),
            None,
        )
        self._show_page(device)
        if self.live.isVisibleTo(self):
            self.live.show_device(device, _find_stale_age(view, now_s))
        self.profile.refresh(view)
        if self.set_up.isChecked():
            self._refresh_set_up(view, device, now_s)

    def _refresh_set_up(
        self, view: InputDisplayState, device: InputDeviceView | None, now_s: float
    ) -> None:
        mapping, calibration = self._make_set_up_sections()
        while self._snapshots:
            snapshot = self._snapshots.popleft()
            mapping.receive(snapshot)
            calibration.receive(snapshot)
        page = self.page
        mapping.setVisible(page is SetUpPage.MAPPING and device is not None)
        mapping.message.setVisible(page is SetUpPage.MAPPING and device is not None)
        calibration.setVisible(page is SetUpPage.CALIBRATION and device is not None)
        if page is SetUpPage.MAPPING:
            mapping.refresh(view, device, now_s)
        elif page is SetUpPage.CALIBRATION:
            calibration.refresh(device, now_s)

    def _refresh(self, _: SessionState) -> None:
        if self.isVisible():
            self.refresh()

    def _on_page_changed(self) -> None:
        """Show another page, and cancel the search for a control, whose row is now hidden."""
        if self.mapping is not None:
            self.mapping.cancel()
        self.refresh()

    @property
    def page(self) -> SetUpPage:
        """The current page."""
        return (
            list(SetUpPage)[self.tabs.currentIndex()]
            if self.set_up.isChecked()
            else SetUpPage.DEVICES
        )

    def _show_page(self, device: InputDeviceView | None) -> None:
        is_setting_up, page = self.set_up.isChecked(), self.page
        self.headline.setVisible(not is_setting_up)
        self.banner.setVisible(is_setting_up)
        self.tabs.setVisible(is_setting_up)
        self.device_list.setVisible(page is SetUpPage.DEVICES)
        self.live.setVisible(page is SetUpPage.DEVICES and device is not None)
        self.problem_list.setVisible(page is SetUpPage.DEVICES and bool(self.problem_list.text))
        self.profile.setVisible(page is not SetUpPage.CALIBRATION)

    def _use_theme(self, theme: Theme) -> None:
        self.live.set_theme(theme)
        if self.calibration is not None:
            self.calibration.set_theme(theme)

    def leave_set_up(self) -> None:
        """Leave the set-up. Each device works again once it has been at rest."""
        self.set_up.setChecked(False)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave the set-up, which disables the stick, because the operator can no longer see it."""
        self.leave_set_up()
        super().hideEvent(event)

    def _toggle_set_up(self, is_set_up: bool) -> None:
        self.set_up.setText(tr("Leave the set-up") if is_set_up else tr("Set up …"))
        if is_set_up:
            self.tabs.setCurrentIndex(list(SetUpPage).index(SetUpPage.MAPPING))
            self._snapshots.clear()
            self._devices.open_mapping()
            self._stop_listening = self._devices.add_listener(self._snapshots.append)
            self.refresh()
            return
        if self._stop_listening is not None:
            self._stop_listening()
            self._stop_listening = None
        self._snapshots.clear()
        mapping, calibration = self._make_set_up_sections()
        mapping.cancel()
        calibration.drop_drafts()
        for widget in (mapping, mapping.message, calibration):
            widget.hide()
        self._devices.close_mapping()
        self.refresh()


def _find_stale_age(view: InputDisplayState, now_s: float) -> float | None:
    """Return the age of the readings, s, if they are out of date, or else None."""
    age_s = now_s - view.host_time_s
    return age_s if age_s > STALE_AGE_S else None
