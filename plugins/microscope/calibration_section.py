"""Guided calibration of each stage: requirements, progress and result."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QLabel, QProgressBar, QWidget

from rotemina.app.microscope import (
    MICRO,
    NANO,
    Microscope,
    MicroscopeActivity,
    MicroscopeStatus,
    StageCalibrationStatus,
)
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    enable_unless,
    make_button,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Workbench
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.feed_notice import find_motion_objection
from rotemina.plugins.microscope.words import (
    END_PHASES,
    describe_calibration,
    describe_stage,
    list_residuals,
)

_GUIDE = mark(
    "1. Bring the tip to the middle of the picture and into focus.\n2. Choose "
    "the objective under Camera: each objective has its own calibration.\n3. "
    "Calibrate the micro stage, then the nano stage: the tip makes small moves "
    "around its position and returns."
)


class StageCalibrationSection(Section):
    """Section with a button for each stage, progress, residuals and the stored calibration."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Calibration"))
        self._workbench, self._microscope = workbench, microscope
        guide = self.add_text()
        guide.setText(tr(_GUIDE))
        self.whole_picture = QCheckBox(tr("the whole picture moves"))
        self.whole_picture.setToolTip(
            make_tooltip(
                tr(
                    "For use without a visible pipette, if stage and specimen move together: "
                    "track the picture itself"
                )
            )
        )
        self.column.addWidget(self.whole_picture)
        self.micro = make_button(tr("Micro stage"), lambda: self._start(MICRO))
        self.nano = make_button(tr("Nano stage"), lambda: self._start(NANO))
        self.add_row(self.micro, self.nano)
        self.abort = make_button(tr("Abort"), lambda: microscope.stop(by=OPERATOR))
        self.progress = name_widget(QProgressBar(), tr("Progress of the calibration"))
        self.progress.setTextVisible(False)
        self.add_row(self.progress, self.abort)
        self.status_label = self.add_text()
        self.residuals = self.add_text()
        self.stored_label = self.add_text()
        self.stored_label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the progress and the stored calibration of the objective."""
        objection = find_motion_objection(status, state)
        enable_unless(
            self.micro,
            objection,
            tr("Move x and y by 40 µm around their position and evaluate the pictures"),
        )
        enable_unless(
            self.nano,
            objection,
            tr(
                "Move the tip by 15 µm with the piezos around its position and evaluate the"
                " pictures"
            ),
        )
        running = status.activity is MicroscopeActivity.CALIBRATION
        for widget in (self.progress, self.abort):
            _set_visible(widget, running)
        enable_unless(
            self.abort, None, tr("Stop the machine in place and keep the previous calibration")
        )
        self._show_status(status.calibration_status)
        show_or_hide_text(self.stored_label, "\n".join(_describe_stored(status)))

    def _show_status(self, status: StageCalibrationStatus | None) -> None:
        show_or_hide_text(self.status_label, describe_calibration(status))
        if status is None:
            show_or_hide_text(self.residuals, "")
            return
        self.progress.setRange(0, status.pictures_total)
        self.progress.setValue(status.pictures_taken)
        lines = list_residuals(status.fit) if status.phase in END_PHASES else []
        show_or_hide_text(self.residuals, "\n".join(lines))

    def _start(self, stage: str) -> None:
        whole_picture = self.whole_picture.isChecked()
        self._workbench.run_request(
            lambda: self._microscope.calibrate(stage, whole_picture=whole_picture)
        )


def _describe_stored(status: MicroscopeStatus) -> list[str]:
    if status.calibration_problem:
        return [status.calibration_problem]
    calibration = status.calibration
    if calibration is None:
        return (
            [
                tr("Objective {objective!r} has no stored calibration.").format(
                    objective=status.objective
                )
            ]
            if status.objective
            else []
        )
    lines = [describe_stage(MICRO, calibration.micro), describe_stage(NANO, calibration.nano)]
    focus = calibration.focus
    if focus is not None:
        lines.append(
            tr("focus: sharpest at {place:.2f} ± {doubt:.2f} µm of {axis}").format(
                place=1e6 * focus.sharpest, doubt=1e6 * focus.uncertainty, axis=focus.axis
            )
        )
    return lines


def _set_visible(widget: QWidget | QLabel, on: bool) -> None:
    if widget.isVisibleTo(widget.parentWidget()) != on:
        widget.setVisible(on)
