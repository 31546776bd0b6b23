"""Controls of the calibration procedure: axis, runs and targets, and the buttons."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QGridLayout,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QWidget,
)

from rotemina.app.calibration import CalibrationPlaybackPhase, CalibrationPlaybackState
from rotemina.app.language import get_axis_label, translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import enable_unless, name_widget
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.text import make_plain_label
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.calibration import tr
from rotemina.plugins.calibration.words import NO_PLAN_TEXT, describe_progress, has_iso_cycles
from rotemina.sim.calibration import DEFAULT_RUNS, DEFAULT_TARGETS
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot


class CalibrationControls(QWidget):
    """Controls of the calibration procedure. The panel carries out their actions.

    Signals
    -------
    changed() : axis, runs or targets have changed. An earlier plan is then obsolete.
    """

    changed = Signal()

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self.axis = name_widget(QComboBox(), tr("Axis"), tr("Axis whose sensor is calibrated"))
        for name in robot.axes:
            self.axis.addItem(get_axis_label(name), name)
        self.runs = _make_count_field(tr("Runs"), 3, 50, DEFAULT_RUNS)
        self.runs.setToolTip(
            tr("3 to 50; each run validates the fit of the others once; ISO 230-2 requires 5")
        )
        self.targets = _make_count_field(tr("Targets"), 5, 101, DEFAULT_TARGETS)
        self.targets.setToolTip(tr("5 to 101 positions, approached from both sides (ISO 230-2)"))
        self.absolute = QCheckBox(tr("the laser's zero is the axis' zero"))
        self.absolute.setChecked(True)
        self.absolute.setToolTip(
            tr("Off: the zero of the laser is arbitrary; the reading at mid-travel stays")
        )
        self.plan, self.run = QPushButton(tr("Plan")), QPushButton(tr("Run"))
        self.stop, self.fit = QPushButton(tr("Stop")), QPushButton(tr("Fit records …"))
        self.run.setProperty("primary", True)
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.status_label = make_plain_label(tr(NO_PLAN_TEXT), quiet=False, wrap=True)
        self._lay_out()
        self.axis.currentIndexChanged.connect(self._on_changed)
        for field in (self.runs, self.targets):
            field.valueChanged.connect(self._on_changed)
        self._on_changed()

    @property
    def chosen_axis(self) -> str:
        """The selected axis."""
        return str(self.axis.currentData())

    def show_run(
        self, state: CalibrationPlaybackState, duration_s: float, waiting_text: str
    ) -> None:
        """Show the progress of the run.

        ``waiting_text`` says what the run is waiting for. It is empty once the run has begun.
        """
        self.progress.setValue(round(1000 * state.progress))
        self.status_label.setText(waiting_text or describe_progress(state, duration_s))

    def refresh(
        self, session: SessionState, motion: Record | None, run: CalibrationPlaybackState
    ) -> None:
        """Enable the actions that are possible now. Tooltips say why the others are not."""
        is_running = run.phase is CalibrationPlaybackPhase.MOVING
        objection = tr("a run is in progress") if is_running else None
        for widget in (self.axis, self.runs, self.absolute):
            widget.setEnabled(not is_running)
        self.targets.setEnabled(not is_running and has_iso_cycles(self._robot, self.chosen_axis))
        enable_unless(
            self.plan, objection, tr("Compute the motion and check it against all limits")
        )
        enable_unless(
            self.fit, objection, tr("Fit records of this axis with its sensor and the laser")
        )
        enable_unless(
            self.stop,
            None if is_running else tr("no run is in progress"),
            tr("Stop the machine now"),
        )
        if objection is None and session.lock_reason is not None:
            objection = translate_message(session.lock_reason)
        if objection is None and motion is None:
            objection = tr("there is no plan yet")
        if objection is None and session.activity is not DeviceState.IDLE:
            objection = tr("the machine is still moving")
        enable_unless(self.run, objection, tr("Play the motion, record sensor and laser, and fit"))

    def _on_changed(self) -> None:
        self.targets.setEnabled(has_iso_cycles(self._robot, self.chosen_axis))
        self.changed.emit()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.addRow(tr("Axis"), self.axis)
        form.addRow(tr("Runs"), self.runs)
        form.addRow(tr("Targets"), self.targets)
        buttons = QGridLayout()
        for index, button in enumerate((self.plan, self.run, self.stop, self.fit)):
            buttons.addWidget(button, index // 2, index % 2)
        parts = form, self.absolute, buttons, self.progress, self.status_label, 1
        make_column(*parts, on=self, margins=(0, 0, 6, 0), spacing=4)


def _make_count_field(name: str, minimum: int, maximum: int, initial_value: int) -> QSpinBox:
    field = name_widget(QSpinBox(), name)
    field.setRange(minimum, maximum)
    field.setValue(initial_value)
    field.setKeyboardTracking(False)
    return field
