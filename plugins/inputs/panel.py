"""Input devices: list, live readings, and set-up."""

from collections import deque
from collections.abc import Callable
from enum import StrEnum

from PySide6.QtCore import QTimer
from PySide6.QtGui import QHideEvent
from PySide6.QtWidgets import QPushButton, QTabBar, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, DeviceView
from rotemina.app.motion.teleoperation.input_devices import InputSnapshot
from rotemina.app.panel import STALE_S, Area, Panel
from rotemina.app.shell.language import marked
from rotemina.app.shell.state_tone import Tone, set_tone
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.calibration_section import CalibrationSection
from rotemina.plugins.inputs.device_list import DeviceList, Troubles
from rotemina.plugins.inputs.live_readings import LiveSection
from rotemina.plugins.inputs.mapping_section import MappingSection
from rotemina.plugins.inputs.profile_section import ProfileSection
from rotemina.plugins.inputs.profiles import ProfileChoice
from rotemina.plugins.inputs.words import NOTHING_SENT, entries, headline, troubles

_MOST_HEARD = 2000  # steps between two frames: some seconds


class Page(StrEnum):
    """What is in sight while the devices are set up."""

    DEVICES = mark("Devices")
    MAPPING = mark("Mapping")
    CALIBRATION = mark("Calibration")


class InputsPanel(Panel):
    """Devices, profile, live bars; while it is set up, mapping and calibration."""

    title = marked("panels", "Input devices")
    area = Area.RIGHT
    order = 25
    help_page = "input-mapping.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._devices = workbench.operation.devices
        self._snapshots: deque[InputSnapshot] = deque(maxlen=_MOST_HEARD)
        self._leave_listening: Callable[[], None] | None = None
        axes = tuple(workbench.robot.axes)
        self.profiles = ProfileChoice(self._devices, workbench.settings, axes)
        wrong = self.profiles.begin()
        if wrong is not None:  # told when the window is there to show it
            QTimer.singleShot(0, self, lambda: workbench.notify(Level.WARNING, wrong, about=self))
        self._make_parts()
        self._lay_out()
        self.follow(self._refresh)
        workbench.theme_changed.connect(self._use_theme)
        workbench.closing.connect(self.leave)
        self.refresh()

    def _make_parts(self) -> None:
        bench = self.workbench
        self.headline = plain_text(wrap=True)
        self.banner = plain_text(wrap=True)
        self.banner.setText(tr(NOTHING_SENT))
        set_tone(self.banner, Tone.WARNING)
        self.set_up = QPushButton(tr("Set up …"))
        self.set_up.setCheckable(True)
        self.set_up.setToolTip(tr("Map and calibrate; meanwhile only stops are sent"))
        self.set_up.toggled.connect(self._toggle)
        self.tabs = named(QTabBar(), tr("Section of the set-up"))
        self.tabs.setDrawBase(False)
        for page in Page:
            self.tabs.addTab(tr(page))
        self.tabs.currentChanged.connect(lambda _: self._turn())
        self.troubles = Troubles()
        self.list = DeviceList()
        self.live = LiveSection(bench.theme)
        self.profile = ProfileSection(bench, self.profiles)
        #: Made when somebody sets up for the first time: most who open the window never do.
        self.mapping: MappingSection | None = None
        self.calibration: CalibrationSection | None = None

    def _lay_out(self) -> None:
        row = in_row((self.headline, 1), self.set_up, spacing=8)
        self._head = in_column(self.banner, row, self.tabs, margins=(10, 8, 10, 4), spacing=6)
        content = QWidget()
        parts = self.list, self.live, self.troubles, self.profile
        self._column = in_column(*parts, 1, on=content, margins=(10, 0, 10, 8), spacing=4)
        in_column(self._head, (scrolled(content, least=320), 1), on=self, margins=0, spacing=0)
        self._show_page(None)

    def _make_set_up(self) -> tuple[MappingSection, CalibrationSection]:
        """Return mapping and calibration, made if they are not there yet."""
        if self.mapping is None or self.calibration is None:
            self.mapping = MappingSection(self.workbench, self.profiles)
            self.calibration = CalibrationSection(self.workbench)
            self._head.addWidget(self.mapping.message)
            place = self._column.indexOf(self.profile)
            self._column.insertWidget(place, self.calibration)
            self._column.insertWidget(place, self.mapping)
        return self.mapping, self.calibration

    # --- what is shown ----------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the devices as they were at their latest step."""
        view, now_s = self._devices.view, self.workbench.operation.clock()
        hub = self._devices.hub
        wrong = troubles(view, hub)
        self.headline.setText(headline(view, len(wrong)))
        self.troubles.show_troubles(wrong)
        self.list.show_entries(entries(view, hub))
        device = next((d for d in view.devices if d.device.identity.key == self.list.key), None)
        self._show_page(device)
        if self.live.isVisibleTo(self):
            self.live.show_device(device, _age(view, now_s))
        self.profile.refresh(view)
        if self.set_up.isChecked():
            self._refresh_set_up(view, device, now_s)

    def _refresh_set_up(self, view: DevicesView, device: DeviceView | None, now_s: float) -> None:
        mapping, calibration = self._make_set_up()
        while self._snapshots:
            snapshot = self._snapshots.popleft()
            mapping.receive(snapshot)
            calibration.receive(snapshot)
        page = self.page
        mapping.setVisible(page is Page.MAPPING and device is not None)
        mapping.message.setVisible(page is Page.MAPPING and device is not None)
        calibration.setVisible(page is Page.CALIBRATION and device is not None)
        if page is Page.MAPPING:
            mapping.refresh(view, device, now_s)
        elif page is Page.CALIBRATION:
            calibration.refresh(device, now_s)

    def _refresh(self, _: SessionState) -> None:
        if self.isVisible():
            self.refresh()

    def _turn(self) -> None:
        """Show another page; a control is looked for only while its row is in sight."""
        if self.mapping is not None:
            self.mapping.cancel()
        self.refresh()

    @property
    def page(self) -> Page:
        """What is in sight."""
        return list(Page)[self.tabs.currentIndex()] if self.set_up.isChecked() else Page.DEVICES

    def _show_page(self, device: DeviceView | None) -> None:
        setting_up, page = self.set_up.isChecked(), self.page
        self.headline.setVisible(not setting_up)
        self.banner.setVisible(setting_up)
        self.tabs.setVisible(setting_up)
        self.list.setVisible(page is Page.DEVICES)
        self.live.setVisible(page is Page.DEVICES and device is not None)
        self.troubles.setVisible(page is Page.DEVICES and bool(self.troubles.text))
        self.profile.setVisible(page is not Page.CALIBRATION)

    def _use_theme(self, theme: Theme) -> None:
        self.live.set_theme(theme)
        if self.calibration is not None:
            self.calibration.set_theme(theme)

    # --- setting up -------------------------------------------------------------------------------

    def leave(self) -> None:
        """Leave the set-up: devices act again once all were seen at rest."""
        self.set_up.setChecked(False)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave what nobody can see: a stick that does nothing must have its reason in sight."""
        self.leave()
        super().hideEvent(event)

    def _toggle(self, on: bool) -> None:
        self.set_up.setText(tr("Leave the set-up") if on else tr("Set up …"))
        if on:
            self.tabs.setCurrentIndex(list(Page).index(Page.MAPPING))
            self._snapshots.clear()
            self._devices.open_mapping()
            self._leave_listening = self._devices.listen(self._snapshots.append)
            self.refresh()
            return
        if self._leave_listening is not None:
            self._leave_listening()
            self._leave_listening = None
        self._snapshots.clear()
        mapping, calibration = self._make_set_up()
        mapping.cancel()
        calibration.leave()
        for part in (mapping, mapping.message, calibration):
            part.hide()
        self._devices.close_mapping()
        self.refresh()


def _age(view: DevicesView, now_s: float) -> float | None:
    """Return how old a view is, where it is too old."""
    age_s = now_s - view.host_time_s
    return age_s if age_s > STALE_S else None
