"""The panel's controls for training, applying and tuning."""

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QWidget,
)

from rotemina.app.display_units import label
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.labels import heading, plain_text
from rotemina.app.widgets.layouts import in_column, in_grid
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.trial_motion import Aid
from rotemina.plugins.compensation.typed_gains import TypedGains
from rotemina.plugins.compensation.words import APPLY, LIVE_LOOP, SWITCH
from rotemina.sim.robot.model import PiezoAxis, Robot

_LEFT = {
    Aid.NONE: mark("Without"),
    Aid.INVERSE: mark("Inverse"),
    Aid.LOOP: mark("Feedback"),
    Aid.BOTH: mark("Both"),
}


class Controls(QWidget):
    """Choices and buttons; what they ask for is done by the panel."""

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self.axis = named(QComboBox(), tr("Axis"), tr("Piezo axis in open loop to be compensated"))
        for name, axis in robot.axes.items():
            if isinstance(axis, PiezoAxis) and axis.controller is None:
                self.axis.addItem(label(name), name)
        self.simulate, self.record = QPushButton(tr("Simulator")), QPushButton(tr("Last record"))
        self.files, self.open, self.save = (
            QPushButton(text) for text in (tr("Records …"), tr("Open …"), tr("Save …"))
        )
        self.kind = named(QComboBox(), tr("Inverse to apply"), tr("Trained inverse to apply"))
        self.switch, self.trial = _switch(SWITCH, primary=True), QPushButton(tr("Try it"))
        self.sweep = QPushButton(tr("Sweep"))
        self.residuals = {one: _told() for one in Aid}
        self.beyond = _told()
        self.tune, self.open_gains = QPushButton(tr("Tune")), QPushButton(tr("Open …"))
        self.keep, self.apply = QPushButton(tr("Save gains …")), _switch(APPLY)
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
        self.doing, self.point = _told(), _told()
        self._lay_out()

    @property
    def chosen(self) -> str:
        """The axis; empty where the robot has no piezo in open loop."""
        return self.axis.currentData() or ""

    def tell(self, text: str, share: float | None) -> None:
        """Show the current work and its progress."""
        self.doing.setText(text)
        self.progress.setVisible(share is not None)
        self.progress.setValue(round(1000.0 * (share or 0.0)))

    def _lay_out(self) -> None:
        grid = in_grid(spacing=5)
        rows: tuple[tuple[tuple[QWidget, int], ...], ...] = (
            ((QLabel(tr("Axis")), 1), (self.axis, 2)),
            ((heading(tr("Train with")), 3),),
            ((self.simulate, 1), (self.record, 1), (self.files, 1)),
            ((self.open, 1), (self.save, 1)),
            ((heading(tr("Feed-forward")), 3),),
            ((self.kind, 3),),
            ((self.switch, 1), (self.sweep, 1), (self.trial, 1)),
            ((heading(tr("Feedback")), 3),),
            ((self.tune, 1), (self.generations, 1)),
            ((self.forward, 3),),
            ((self.point, 3),),
            ((self.typed, 3),),
            ((self.apply, 1), (self.keep, 1), (self.open_gains, 1)),
            ((heading(tr("Remaining error of a trial")), 3),),
            *(((QLabel(tr(_LEFT[one])), 1), (told, 2)) for one, told in self.residuals.items()),
            ((self.beyond, 3),),
        )
        for number, row in enumerate(rows):
            column = 0
            for widget, span in row:
                grid.addWidget(widget, number, column, 1, span)
                column += span
        remark = plain_text(tr(LIVE_LOOP), wrap=True)
        in_column(
            grid, remark, self.doing, self.progress, self.stop, 1, on=self, margins=(0, 0, 4, 0)
        )


def _told() -> QLabel:
    return plain_text(quiet=False, wrap=True)


def _switch(texts: tuple[str, str], *, primary: bool = False) -> ChangingButton:
    """Return a button with room for both of its texts, which shows the first."""
    button = ChangingButton(*(tr(text) for text in texts))
    button.setProperty("primary", primary)  # its bold text takes more room
    return button
