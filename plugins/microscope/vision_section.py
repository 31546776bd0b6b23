"""Image analysis: tip, cell, focus and drift."""

from PySide6.QtWidgets import QCheckBox, QLineEdit

from rotemina.app.errors import MicroscopeError
from rotemina.app.language import translate_message
from rotemina.app.microscope import Microscope, MicroscopeActivity, MicroscopeStatus, TipState
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Workbench
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import find_motion_objection
from rotemina.plugins.microscope.words import (
    describe_cell,
    describe_drift,
    describe_focus,
    describe_focus_axis,
    describe_tip,
)
from rotemina.sim.messages import format_rounded, parse_number

# The autofocus searches this far on each side of the current position.
_DEFAULT_SEARCH_DISTANCE_M = 50e-6


class TipTrackingSection(Section):
    """Section to track the tip and to monitor drift."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Tip"))
        self.track = QCheckBox(tr("track the tip"))
        self.track.setToolTip(
            make_tooltip(
                tr(
                    "Find the pipette tip in every picture; to help the search, click it with "
                    "Tip, above"
                )
            )
        )
        self.track.clicked.connect(lambda on: workbench.run_request(lambda: microscope.track(on)))
        self.background = make_button(
            tr("Take background"),
            lambda: workbench.run_request(microscope.tracker.take_background),
            tr("Save the background without the tip in the picture"),
        )
        self.drift = QCheckBox(tr("monitor drift"))
        self.drift.setToolTip(make_tooltip(tr("Displacement of the background since it was taken")))
        self.drift.clicked.connect(
            lambda on: workbench.run_request(lambda: microscope.picture_jobs.watch_drift(on))
        )
        self.column.addWidget(self.track)
        self.status_label = self.add_text()
        self.column.addWidget(self.background)
        self.column.addWidget(self.drift)
        self.drift_label = self.add_text()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the position of the tip and the drift."""
        is_on = status.tip.state is not TipState.OFF
        if self.track.isChecked() != is_on:
            self.track.setChecked(is_on)
        counts_text = (
            tr("\n{looked} pictures evaluated, {passed} skipped").format(
                looked=status.frames_processed, passed=status.frames_skipped
            )
            if is_on
            else ""
        )
        show_or_hide_text(self.status_label, describe_tip(status.tip) + counts_text)
        objection = None if status.feed.frame is not None else tr("there is no picture")
        background_state = tr("taken") if status.has_background else tr("not taken yet")
        enable_unless(
            self.background,
            objection,
            tr(
                "Save the background without the tip, so that cells do not disturb the "
                "tracking; {about}"
            ).format(about=background_state),
        )
        if self.drift.isChecked() != status.drift.is_watched:
            self.drift.setChecked(status.drift.is_watched)
        show_or_hide_text(self.drift_label, describe_drift(status.drift))


class CellSection(Section):
    """Section with the size of the outlined cell and the distance of its membrane."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Cell"))
        self._guide = self.add_text()
        self._guide.setText(tr("With Cell, above the picture, a click outlines a cell."))
        self.status_label = self.add_text()
        self.forget = make_button(
            tr("Remove cell"),
            lambda: workbench.run_request(microscope.picture_jobs.clear_outline),
            tr("Remove the outline"),
        )
        self.column.addWidget(self.forget)

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show size and distance."""
        show_or_hide_text(self.status_label, describe_cell(status))
        objection = tr("no cell is outlined") if status.cell.outline is None else None
        enable_unless(self.forget, objection, tr("Remove the outline"))


class FocusSection(Section):
    """Section for autofocus with the focus drive or with an axis of the machine."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Focus"))
        self._workbench, self._microscope = workbench, microscope
        self._status = MicroscopeStatus()
        self.drive_choice = WheelSafeComboBox(tr("Drive for focusing"), letters=6)
        self.reach = QLineEdit(format_rounded(1e6 * _DEFAULT_SEARCH_DISTANCE_M))
        self.reach.setAccessibleName(tr("Search distance each way, µm"))
        self.reach.setToolTip(
            make_tooltip(tr("Search distance each way from the present position, above 0 µm"))
        )
        self.search = make_button(
            tr("Autofocus"), self._autofocus, tr("Find the sharpest focus and stay there")
        )
        self.column.addWidget(self.drive_choice)
        self.add_row(self.reach, self.search)
        self.goal = QLineEdit()
        self.goal.setPlaceholderText(tr("focus at, µm"))
        self.goal.setAccessibleName(tr("Position of the focus drive, µm"))
        self.goal.setToolTip(make_tooltip(tr("Target of the drive, µm, within its range")))
        self.move = make_button(
            tr("Move focus"), self._move, tr("Move the focus drive of the microscope")
        )
        self.goal.returnPressed.connect(self._move)
        self.add_row(self.goal, self.move)
        self.status_label = self.add_text()

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the available drives and the progress of the search."""
        self._status = status
        names = [axis.name for axis in status.focus_axes]
        if names != [self.drive_choice.itemData(row) for row in range(self.drive_choice.count())]:
            self.drive_choice.clear()
            for name in names:
                self.drive_choice.addItem(name, name)
        for row, axis in enumerate(status.focus_axes):
            self.drive_choice.setItemText(row, describe_focus_axis(axis))
        drive_objection = (
            None
            if names
            else tr("no focus drive is available: open a camera or connect the machine")
        )
        search_objection = drive_objection or find_motion_objection(status, state)
        enable_unless(self.search, search_objection, tr("Find the sharpest focus and stay there"))
        no_drive = None if "focus" in names else tr("this camera has no focus drive")
        busy_objection = (
            None
            if status.activity is MicroscopeActivity.NONE
            else tr("{activity} is running").format(activity=translate_message(status.activity))
        )
        enable_unless(
            self.move, no_drive or busy_objection, tr("Move the focus drive of the microscope")
        )
        show_or_hide_text(self.status_label, describe_focus(status.focus_status))

    def _autofocus(self) -> None:
        name = self.drive_choice.currentData()
        drive = next((axis for axis in self._status.focus_axes if axis.name == name), None)

        def start() -> None:
            reach_m = _parse_metres(tr("search distance"), self.reach.text())
            if drive is None or drive.position is None:
                self._microscope.procedures.autofocus(name)
                return
            low, high = (
                max(drive.position - reach_m, drive.low),
                min(drive.position + reach_m, drive.high),
            )
            self._microscope.procedures.autofocus(name, low, high)

        self._workbench.run_request(start)

    def _move(self) -> None:
        self._workbench.run_request(
            lambda: self._microscope.move_focus(_parse_metres(tr("focus"), self.goal.text()))
        )


def _parse_metres(name: str, text: str) -> float:
    number = parse_number(text)
    if number is None:
        raise MicroscopeError(
            tr("{name}: {text!r} is not a number; enter one in µm").format(
                name=name, text=text.strip()
            )
        )
    return 1e-6 * number
