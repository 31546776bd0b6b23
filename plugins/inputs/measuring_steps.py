"""Steps of the measurement of a device: choice of axes, rest, ends, and result."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QWidget

from rotemina.app.language import translate_message
from rotemina.app.motion.inputs import InputDeviceView
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import (
    clear_layout,
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import make_plain_label, show_or_hide_text
from rotemina.app.workbench import Workbench
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.calibration_progress import CalibrationProgress, CalibrationStep

_STEP_TEXTS = {
    CalibrationStep.EDIT: mark(
        "Choose the axes to measure. Tick the ones that rest at an end, such as "
        "triggers and pedals."
    ),
    CalibrationStep.REST: mark("1 of 2: release the device and do not touch it."),
    CalibrationStep.SWEEP: mark("2 of 2: move each axis several times to both ends."),
}


class AxisMeasurementView(QWidget):
    """View that guides the operator through the measurement of the axes of a device.

    Signals
    -------
    measured()
        Emitted when the measured axes have been entered in the draft.
    """

    measured = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._progress: CalibrationProgress | None = None
        self._device: InputDeviceView | None = None
        self._now_s = 0.0
        self.text = make_plain_label(wrap=True)
        self.axis_boxes: dict[str, QCheckBox] = {}
        self.one_sided_boxes: dict[str, QCheckBox] = {}
        self.axis_choice = QWidget()
        self._grid = make_grid(on=self.axis_choice, margins=0, spacing=(-1, 2))
        self.problems = make_plain_label(wrap=True)
        self.next_button = make_button(tr("Measure …"), self._advance)
        self.cancel_button = make_button(tr("Cancel"), self._cancel_measurement)
        row = make_row((self.next_button, 1), self.cancel_button, spacing=6)
        make_column(self.text, self.axis_choice, self.problems, row, on=self, margins=0, spacing=4)

    def refresh(self, progress: CalibrationProgress, device: InputDeviceView, now_s: float) -> None:
        """Show the current step of the measurement."""
        if progress is not self._progress:
            self._progress = progress
            self._make_boxes(progress)
        self._device, self._now_s = device, now_s
        self.setVisible(bool(device.device.axes))
        show_or_hide_text(self.text, tr(_STEP_TEXTS[progress.step]))
        self.axis_choice.setVisible(progress.step is CalibrationStep.EDIT)
        self.cancel_button.setVisible(progress.step is not CalibrationStep.EDIT)
        self._show_problems(progress)
        self._update_next_button(progress, now_s)

    def _show_problems(self, progress: CalibrationProgress) -> None:
        problems = (
            progress.open_problems if progress.step is CalibrationStep.SWEEP else progress.problems
        )
        heading = (
            "" if progress.step is CalibrationStep.SWEEP or not problems else tr("Unchanged:\n")
        )
        show_or_hide_text(
            self.problems,
            heading + "\n".join(map(translate_message, problems.values())) if problems else "",
        )

    def _update_next_button(self, progress: CalibrationProgress, now_s: float) -> None:
        if progress.step is CalibrationStep.EDIT:
            objection = (
                None
                if any(box.isChecked() for box in self.axis_boxes.values())
                else tr("no axis is ticked")
            )
            self.next_button.setText(tr("Measure …"))
            enable_unless(
                self.next_button, objection, tr("Measure rest and ends of the ticked axes")
            )
        elif progress.step is CalibrationStep.REST:
            remaining_s = progress.compute_remaining_rest_s(now_s)
            self.next_button.setText(
                tr("At rest: next")
                if remaining_s == 0.0
                else tr("{left_s:.1f} s …").format(left_s=remaining_s)
            )
            enable_unless(
                self.next_button,
                None if remaining_s == 0.0 else tr("measuring the noise"),
                tr("Continue with the ends"),
            )
        else:
            is_complete = len(progress.ranges) and not progress.open_problems
            self.next_button.setText(tr("Done") if is_complete else tr("Done, without these"))
            enable_unless(self.next_button, None, tr("Use the successful measurements"))

    def _advance(self) -> None:
        progress, device = self._progress, self._device
        if progress is None or device is None:
            return
        if progress.step is CalibrationStep.EDIT:
            axes = [axis for axis, box in self.axis_boxes.items() if box.isChecked()]
            one_sided_axes = [axis for axis, box in self.one_sided_boxes.items() if box.isChecked()]
            latest_reading, now_s = device.latest_reading, self._now_s
            self._workbench.run_request(
                lambda: progress.begin(axes, one_sided_axes, latest_reading, now_s)
            )
        elif progress.step is CalibrationStep.REST:
            progress.start_sweep()
        else:
            progress.finish()
            self.measured.emit()

    def _cancel_measurement(self) -> None:
        if self._progress is not None:
            self._progress.cancel()

    def _make_boxes(self, progress: CalibrationProgress) -> None:
        clear_layout(self._grid)
        self.axis_boxes, self.one_sided_boxes = {}, {}
        for row, axis in enumerate(progress.device.axes):
            axis_box, one_sided_box = QCheckBox(axis), QCheckBox(tr("rests at an end"))
            axis_box.setChecked(axis in progress.measurable_axes)
            axis_box.setAccessibleName(tr("Measure axis {axis}").format(axis=axis))
            one_sided_box.setChecked(axis in progress.one_sided_axes)
            one_sided_box.setAccessibleName(tr("Axis {axis} rests at an end").format(axis=axis))
            self._grid.addWidget(axis_box, row, 0)
            self._grid.addWidget(one_sided_box, row, 1, Qt.AlignmentFlag.AlignLeft)
            self.axis_boxes[axis], self.one_sided_boxes[axis] = axis_box, one_sided_box
        self._grid.setColumnStretch(1, 1)
