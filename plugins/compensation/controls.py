"""Controls of the panel for training, applying and tuning."""

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QWidget,
)

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import ChangingButton, name_widget
from rotemina.app.widgets.layout import make_column, make_grid
from rotemina.app.widgets.text import make_heading, make_plain_label
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.trial_motion import CompensationMode
from rotemina.plugins.compensation.typed_gains import TypedGains
from rotemina.plugins.compensation.words import INVERSE_BUTTON_TEXTS, LIVE_LOOP, LOOP_BUTTON_TEXTS
from rotemina.sim.robot import PiezoAxis, Robot

_MODE_LABELS = {
    CompensationMode.NONE: mark("Without"),
    CompensationMode.INVERSE: mark("Inverse"),
    CompensationMode.LOOP: mark("Feedback"),
    CompensationMode.BOTH: mark("Both"),
}


class CompensationControls(QWidget):
    """Fields and buttons. The panel carries out their actions."""

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self.axis = name_widget(
            QComboBox(), tr("Axis"), tr("Piezo axis in open loop to be compensated")
        )
        for name, axis in robot.axes.items():
            if isinstance(axis, PiezoAxis) and axis.controller is None:
                self.axis.addItem(get_axis_label(name), name)
        self.simulate, self.record = QPushButton(tr("Simulator")), QPushButton(tr("Last record"))
        self.files, self.open, self.save = (
            QPushButton(text) for text in (tr("Records …"), tr("Open …"), tr("Save …"))
        )
        self.kind = name_widget(QComboBox(), tr("Inverse to apply"), tr("Trained inverse to apply"))
        self.switch, self.trial = (
            _make_switch(INVERSE_BUTTON_TEXTS, primary=True),
            QPushButton(tr("Try it")),
        )
        self.sweep = QPushButton(tr("Sweep"))
        self.residuals = {mode: _make_text_label() for mode in CompensationMode}
        self.warnings = _make_text_label()
        self.tune, self.open_gains = QPushButton(tr("Tune")), QPushButton(tr("Open …"))
        self.keep, self.apply = QPushButton(tr("Save gains …")), _make_switch(LOOP_BUTTON_TEXTS)
        self.generations = QSpinBox()
        self.generations.setRange(1, 500)
        self.generations.setValue(50)
        self.generations.setAccessibleName(tr("Generations of 60 individuals"))
        self.generations.setToolTip(tr("1 to 500 generations of 60 individuals each"))
        self.forward = QCheckBox(tr("through the inverse"))
        self.forward.setToolTip(tr("Feed the reference forward through the current inverse"))
        self.typed = TypedGains(robot)
        self.stop = QPushButton(tr("Stop"))
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.doing, self.point = _make_text_label(), _make_text_label()
        self._lay_out()

    @property
    def chosen(self) -> str:
        """The chosen axis. Empty if the robot has no piezo axis in open loop."""
        return self.axis.currentData() or ""

    def show_progress(self, text: str, share: float | None) -> None:
        """Show the current work and its progress, 0 to 1. None hides the progress bar."""
        self.doing.setText(text)
        self.progress.setVisible(share is not None)
        self.progress.setValue(round(1000.0 * (share or 0.0)))

    def _lay_out(self) -> None:
        grid = make_grid(spacing=5)
        rows: tuple[tuple[tuple[QWidget, int], ...], ...] = (
            ((QLabel(tr("Axis")), 1), (self.axis, 2)),
            ((make_heading(tr("Train with")), 3),),
            ((self.simulate, 1), (self.record, 1), (self.files, 1)),
            ((self.open, 1), (self.save, 1)),
            ((make_heading(tr("Feed-forward")), 3),),
            ((self.kind, 3),),
            ((self.switch, 1), (self.sweep, 1), (self.trial, 1)),
            ((make_heading(tr("Feedback")), 3),),
            ((self.tune, 1), (self.generations, 1)),
            ((self.forward, 3),),
            ((self.point, 3),),
            ((self.typed, 3),),
            ((self.apply, 1), (self.keep, 1), (self.open_gains, 1)),
            ((make_heading(tr("Remaining error of a trial")), 3),),
            *(
                ((QLabel(tr(_MODE_LABELS[mode])), 1), (text, 2))
                for mode, text in self.residuals.items()
            ),
            ((self.warnings, 3),),
        )
        for row_index, row in enumerate(rows):
            column = 0
            for widget, span in row:
                grid.addWidget(widget, row_index, column, 1, span)
                column += span
        remark = make_plain_label(tr(LIVE_LOOP), wrap=True)
        make_column(
            grid, remark, self.doing, self.progress, self.stop, 1, on=self, margins=(0, 0, 4, 0)
        )


def _make_text_label() -> QLabel:
    return make_plain_label(quiet=False, wrap=True)


def _make_switch(texts: tuple[str, str], *, primary: bool = False) -> ChangingButton:
    button = ChangingButton(*(tr(text) for text in texts))
    # The text of a primary button is bold and needs more room.
    button.setProperty("primary", primary)
    return button
