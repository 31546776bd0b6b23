"""Findings in the picture: tip, cell, focus, drift."""

from PySide6.QtWidgets import QCheckBox, QLineEdit

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import Activity, MicroscopeStatus, TipState
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import against_moving
from rotemina.plugins.microscope.words import (
    cell_text,
    drift_text,
    focus_name,
    focus_text,
    tip_text,
)
from rotemina.sim.quantities import parsed, rounded

_PRESET_M = 50e-6  # each way from where it is


class TipSection(Section):
    """Tracking on or off, and what it says."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Tip"))
        self.track = QCheckBox(tr("track the tip"))
        self.track.setToolTip(
            plain_tip(
                tr(
                    "Find the pipette tip in every picture; to help the search, click it with "
                    "Tip, above"
                )
            )
        )
        self.track.clicked.connect(lambda on: workbench.ask(lambda: microscope.track(on)))
        self.background = button(
            tr("Take background"),
            lambda: workbench.ask(microscope.tracker.take_ground),
            tr("Save the background without the tip in the picture"),
        )
        self.drift = QCheckBox(tr("monitor drift"))
        self.drift.setToolTip(plain_tip(tr("Displacement of the background since it was taken")))
        self.drift.clicked.connect(
            lambda on: workbench.ask(lambda: microscope.jobs.watch_drift(on))
        )
        self.column.addWidget(self.track)
        self.said = self.add_text()
        self.column.addWidget(self.background)
        self.column.addWidget(self.drift)
        self.drifted = self.add_text()

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show the tip's figures."""
        on = status.tip.state is not TipState.OFF
        if self.track.isChecked() != on:
            self.track.setChecked(on)
        looked, passed = status.frames_processed, status.frames_skipped
        figures = (
            tr("\n{looked} pictures evaluated, {passed} skipped").format(
                looked=looked, passed=passed
            )
            if on
            else ""
        )
        show_text(self.said, tip_text(status.tip) + figures)
        none = None if status.feed.frame is not None else tr("there is no picture")
        about = tr("taken") if status.background else tr("not taken yet")
        allow(
            self.background,
            none,
            tr(
                "Save the background without the tip, so that cells do not disturb the "
                "tracking; {about}"
            ).format(about=about),
        )
        if self.drift.isChecked() != status.drift.watched:
            self.drift.setChecked(status.drift.watched)
        show_text(self.drifted, drift_text(status.drift))


class CellSection(Section):
    """The outline of a cell, and how far its membrane is."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Cell"))
        self._guide = self.add_text()
        self._guide.setText(tr("With Cell, above the picture, a click outlines a cell."))
        self.said = self.add_text()
        self.forget = button(
            tr("Remove cell"),
            lambda: workbench.ask(microscope.jobs.forget),
            tr("Remove the outline"),
        )
        self.column.addWidget(self.forget)

    def refresh(self, status: MicroscopeStatus) -> None:
        """Show size and distance."""
        show_text(self.said, cell_text(status))
        none = tr("no cell is outlined") if status.cell.outline is None else None
        allow(self.forget, none, tr("Remove the outline"))


class FocusSection(Section):
    """Autofocus with the microscope's drive, or with an axis of the machine."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Focus"))
        self._workbench, self._microscope = workbench, microscope
        self._status = MicroscopeStatus()
        self.place = SteadyChoice(tr("Drive for focusing"), letters=6)
        self.reach = QLineEdit(rounded(1e6 * _PRESET_M))
        self.reach.setAccessibleName(tr("Search distance each way, µm"))
        self.reach.setToolTip(
            plain_tip(tr("Search distance each way from the present position, above 0 µm"))
        )
        self.search = button(
            tr("Autofocus"), self._autofocus, tr("Find the sharpest focus and stay there")
        )
        self.column.addWidget(self.place)
        self.add_row(self.reach, self.search)
        self.goal = QLineEdit()
        self.goal.setPlaceholderText(tr("focus at, µm"))
        self.goal.setAccessibleName(tr("Position of the focus drive, µm"))
        self.goal.setToolTip(plain_tip(tr("Target of the drive, µm, within its range")))
        self.move = button(
            tr("Move focus"), self._move, tr("Move the focus drive of the microscope")
        )
        self.goal.returnPressed.connect(self._move)
        self.add_row(self.goal, self.move)
        self.said = self.add_text()

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show what can be focused with, and how the search goes."""
        self._status = status
        names = [one.name for one in status.focus_axes]
        if names != [self.place.itemData(row) for row in range(self.place.count())]:
            self.place.clear()
            for name in names:
                self.place.addItem(name, name)
        for row, one in enumerate(status.focus_axes):
            self.place.setItemText(row, focus_name(one))
        none = (
            None
            if names
            else tr("no focus drive is available: open a camera or connect the machine")
        )
        why = none or against_moving(status, state)
        allow(self.search, why, tr("Find the sharpest focus and stay there"))
        drive = None if "focus" in names else tr("this camera has no focus drive")
        busy = (
            None
            if status.activity is Activity.NONE
            else tr("{activity} is running").format(activity=spoken(status.activity))
        )
        allow(self.move, drive or busy, tr("Move the focus drive of the microscope"))
        show_text(self.said, focus_text(status.focusing))

    def _autofocus(self) -> None:
        name = self.place.currentData()
        chosen = next((one for one in self._status.focus_axes if one.name == name), None)

        def begin() -> None:
            reach_m = _micrometres(tr("search distance"), self.reach.text())
            if chosen is None or chosen.position is None:
                self._microscope.adjustments.autofocus(name)
                return
            low, high = (
                max(chosen.position - reach_m, chosen.low),
                min(chosen.position + reach_m, chosen.high),
            )
            self._microscope.adjustments.autofocus(name, low, high)

        self._workbench.ask(begin)

    def _move(self) -> None:
        self._workbench.ask(
            lambda: self._microscope.move_focus(_micrometres(tr("focus"), self.goal.text()))
        )


def _micrometres(name: str, text: str) -> float:
    number = parsed(text)
    if number is None:
        raise MicroscopeError(
            tr("{name}: {text!r} is not a number; enter one in µm").format(
                name=name, text=text.strip()
            )
        )
    return 1e-6 * number
