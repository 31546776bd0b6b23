"""The procedure's controls: which axis, how many runs, plan, run, stop, or fit files."""

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

from rotemina.app.calibration.calibration_playback import Phase, RunState
from rotemina.app.display_units import label
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.widgets.controls import allow, named
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.calibration import tr
from rotemina.plugins.calibration.words import NOTHING, cycles, progress
from rotemina.sim.calibration.plan import RUNS, TARGETS
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot


class Procedure(QWidget):
    """Choices and buttons; what they ask for is done by the panel.

    Signals
    -------
    changed() : axis, runs or targets are others; a plan made before is of no use.
    """

    changed = Signal()

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self.axis = named(QComboBox(), tr("Axis"), tr("Axis whose sensor is calibrated"))
        for name in robot.axes:
            self.axis.addItem(label(name), name)
        self.runs = _count(tr("Runs"), 3, 50, RUNS)
        self.runs.setToolTip(
            tr("3 to 50; each run validates the fit of the others once; ISO 230-2 requires 5")
        )
        self.targets = _count(tr("Targets"), 5, 101, TARGETS)
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
        self.told = plain_text(tr(NOTHING), quiet=False, wrap=True)
        self._lay_out()
        self.axis.currentIndexChanged.connect(self._change)
        for field in (self.runs, self.targets):
            field.valueChanged.connect(self._change)
        self._change()

    @property
    def chosen(self) -> str:
        """The axis."""
        return str(self.axis.currentData())

    def show_run(self, state: RunState, duration_s: float, waits: str) -> None:
        """Show how far the run is; ``waits`` is what it waits for, empty where it has begun."""
        self.progress.setValue(round(1000 * state.progress))
        self.told.setText(waits or progress(state, duration_s))

    def refresh(self, session: SessionState, motion: Record | None, run: RunState) -> None:
        """Enable what can be done now, and say why the rest cannot."""
        moving = run.phase is Phase.MOVING
        why_not = tr("a run is in progress") if moving else None
        for widget in (self.axis, self.runs, self.absolute):
            widget.setEnabled(not moving)
        self.targets.setEnabled(not moving and cycles(self._robot, self.chosen))
        allow(self.plan, why_not, tr("Compute the motion and check it against all limits"))
        allow(self.fit, why_not, tr("Fit records of this axis with its sensor and the laser"))
        allow(
            self.stop, None if moving else tr("no run is in progress"), tr("Stop the machine now")
        )
        if why_not is None and session.locked is not None:
            why_not = spoken(session.locked)
        if why_not is None and motion is None:
            why_not = tr("there is no plan yet")
        if why_not is None and session.activity is not DeviceState.IDLE:
            why_not = tr("the machine is still moving")
        allow(self.run, why_not, tr("Play the motion, record sensor and laser, and fit"))

    def _change(self) -> None:
        self.targets.setEnabled(cycles(self._robot, self.chosen))
        self.changed.emit()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.addRow(tr("Axis"), self.axis)
        form.addRow(tr("Runs"), self.runs)
        form.addRow(tr("Targets"), self.targets)
        buttons = QGridLayout()
        for place, button in enumerate((self.plan, self.run, self.stop, self.fit)):
            buttons.addWidget(button, place // 2, place % 2)
        parts = form, self.absolute, buttons, self.progress, self.told, 1
        in_column(*parts, on=self, margins=(0, 0, 6, 0), spacing=4)


def _count(name: str, least: int, most: int, preset: int) -> QSpinBox:
    field = named(QSpinBox(), name)
    field.setRange(least, most)
    field.setValue(preset)
    field.setKeyboardTracking(False)
    return field
