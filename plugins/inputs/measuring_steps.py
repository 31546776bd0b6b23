"""The steps of measuring a device: choice of axes, rest, ends, outcome."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QWidget

from rotemina.app.motion.teleoperation.input_arbiter import DeviceView
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import plain_text, show_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.app.widgets.section import clear
from rotemina.plugins.inputs import mark, tr
from rotemina.plugins.inputs.calibration_progress import Calibrating, Step

_TEXTS = {
    Step.EDIT: mark(
        "Choose the axes to measure. Tick the ones that rest at an end, such as "
        "triggers and pedals."
    ),
    Step.REST: mark("1 of 2: release the device and do not touch it."),
    Step.SWEEP: mark("2 of 2: move each axis several times to both ends."),
}


class Measuring(QWidget):
    """Measures the axes of a device.

    Signals
    -------
    measured() : there is something new in the draft.
    """

    measured = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._now: Calibrating | None = None
        self._device: DeviceView | None = None
        self._now_s = 0.0
        self.text = plain_text(wrap=True)
        self.wanted: dict[str, QCheckBox] = {}
        self.one_sided: dict[str, QCheckBox] = {}
        self.choice = QWidget()
        self._grid = in_grid(on=self.choice, margins=0, spacing=(-1, 2))
        self.problems = plain_text(wrap=True)
        self.next = button(tr("Measure …"), self._next)
        self.cancel = button(tr("Cancel"), self._cancel)
        row = in_row((self.next, 1), self.cancel, spacing=6)
        in_column(self.text, self.choice, self.problems, row, on=self, margins=0, spacing=4)

    def refresh(self, now: Calibrating, device: DeviceView, now_s: float) -> None:
        """Show where the measurement of a device is."""
        if now is not self._now:
            self._now = now
            self._offer(now)
        self._device, self._now_s = device, now_s
        self.setVisible(bool(device.device.axes))
        show_text(self.text, tr(_TEXTS[now.step]))
        self.choice.setVisible(now.step is Step.EDIT)
        self.cancel.setVisible(now.step is not Step.EDIT)
        self._show_problems(now)
        self._show_next(now, now_s)

    def _show_problems(self, now: Calibrating) -> None:
        problems = now.missing if now.step is Step.SWEEP else now.problems
        lead = "" if now.step is Step.SWEEP or not problems else tr("Unchanged:\n")
        show_text(
            self.problems, lead + "\n".join(map(spoken, problems.values())) if problems else ""
        )

    def _show_next(self, now: Calibrating, now_s: float) -> None:
        if now.step is Step.EDIT:
            why = (
                None
                if any(box.isChecked() for box in self.wanted.values())
                else tr("no axis is ticked")
            )
            self.next.setText(tr("Measure …"))
            allow(self.next, why, tr("Measure rest and ends of the ticked axes"))
        elif now.step is Step.REST:
            left_s = now.rest_left_s(now_s)
            self.next.setText(
                tr("At rest: next")
                if left_s == 0.0
                else tr("{left_s:.1f} s …").format(left_s=left_s)
            )
            allow(
                self.next,
                None if left_s == 0.0 else tr("measuring the noise"),
                tr("Continue with the ends"),
            )
        else:
            good = len(now.ranges) and not now.missing
            self.next.setText(tr("Done") if good else tr("Done, without these"))
            allow(self.next, None, tr("Use the successful measurements"))

    def _next(self) -> None:
        now, device = self._now, self._device
        if now is None or device is None:
            return
        if now.step is Step.EDIT:
            wanted = [axis for axis, box in self.wanted.items() if box.isChecked()]
            sides = [axis for axis, box in self.one_sided.items() if box.isChecked()]
            last, now_s = device.newest, self._now_s
            self._workbench.ask(lambda: now.begin(wanted, sides, last, now_s))
        elif now.step is Step.REST:
            now.sweep()
        else:
            now.finish()
            self.measured.emit()

    def _cancel(self) -> None:
        if self._now is not None:
            self._now.cancel()

    def _offer(self, now: Calibrating) -> None:
        clear(self._grid)
        self.wanted, self.one_sided = {}, {}
        for row, axis in enumerate(now.device.axes):
            wanted, side = QCheckBox(axis), QCheckBox(tr("rests at an end"))
            wanted.setChecked(axis in now.measurable)
            wanted.setAccessibleName(tr("Measure axis {axis}").format(axis=axis))
            side.setChecked(axis in now.one_sided)
            side.setAccessibleName(tr("Axis {axis} rests at an end").format(axis=axis))
            self._grid.addWidget(wanted, row, 0)
            self._grid.addWidget(side, row, 1, Qt.AlignmentFlag.AlignLeft)
            self.wanted[axis], self.one_sided[axis] = wanted, side
        self._grid.setColumnStretch(1, 1)
