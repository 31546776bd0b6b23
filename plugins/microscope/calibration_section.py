"""Guided calibration of each stage: requirements, progress, result."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QLabel, QProgressBar, QWidget

from rotemina.app.microscope.calibration_file import MICRO, NANO
from rotemina.app.microscope.calibration_run import CalibrationStatus
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import Activity, MicroscopeStatus
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, named, plain_tip
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.feed_notice import against_moving
from rotemina.plugins.microscope.words import ENDED, calibration_text, residual_lines, stage_text

_GUIDE = mark(
    "1. Bring the tip to the middle of the picture and into focus.\n2. Choose "
    "the objective under Camera: each objective has its own calibration.\n3. "
    "Calibrate the micro stage, then the nano stage: the tip makes small moves "
    "around its position and returns."
)


class CalibrationSection(Section):
    """One button a stage, progress, residuals, and what is kept for the objective."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Calibration"))
        self._workbench, self._microscope = workbench, microscope
        guide = self.add_text()
        guide.setText(tr(_GUIDE))
        self.whole = QCheckBox(tr("the whole picture moves"))
        self.whole.setToolTip(
            plain_tip(
                tr(
                    "For use without a visible pipette, if stage and specimen move together: "
                    "track the picture itself"
                )
            )
        )
        self.column.addWidget(self.whole)
        self.micro = button(tr("Micro stage"), lambda: self._begin(MICRO))
        self.nano = button(tr("Nano stage"), lambda: self._begin(NANO))
        self.add_row(self.micro, self.nano)
        self.abort = button(tr("Abort"), lambda: microscope.stop(by=OPERATOR))
        self.progress = named(QProgressBar(), tr("Progress of the calibration"))
        self.progress.setTextVisible(False)
        self.add_row(self.progress, self.abort)
        self.said = self.add_text()
        self.residuals = self.add_text()
        self.known = self.add_text()
        self.known.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the progress, and the stored results."""
        why = against_moving(status, state)
        allow(
            self.micro,
            why,
            tr("Move x and y by 40 µm around their position and evaluate the pictures"),
        )
        allow(
            self.nano,
            why,
            tr(
                "Move the tip by 15 µm with the piezos around its position and evaluate the"
                " pictures"
            ),
        )
        running = status.activity is Activity.CALIBRATION
        for widget in (self.progress, self.abort):
            _show(widget, running)
        allow(self.abort, None, tr("Stop the machine in place and keep the previous calibration"))
        self._show_status(status.calibrating)
        show_text(self.known, "\n".join(_known(status)))

    def _show_status(self, status: CalibrationStatus | None) -> None:
        show_text(self.said, calibration_text(status))
        if status is None:
            show_text(self.residuals, "")
            return
        self.progress.setRange(0, status.moves)
        self.progress.setValue(status.done)
        lines = residual_lines(status.fit) if status.phase in ENDED else []
        show_text(self.residuals, "\n".join(lines))

    def _begin(self, stage: str) -> None:
        whole = self.whole.isChecked()
        self._workbench.ask(lambda: self._microscope.calibrate(stage, whole_picture=whole))


def _known(status: MicroscopeStatus) -> list[str]:
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
    lines = [stage_text(MICRO, calibration.micro), stage_text(NANO, calibration.nano)]
    focus = calibration.focus
    if focus is not None:
        lines.append(
            tr("focus: sharpest at {place:.2f} ± {doubt:.2f} µm of {axis}").format(
                place=1e6 * focus.sharpest, doubt=1e6 * focus.uncertainty, axis=focus.axis
            )
        )
    return lines


def _show(widget: QWidget | QLabel, on: bool) -> None:
    if widget.isVisibleTo(widget.parentWidget()) != on:
        widget.setVisible(on)
