"""The panel's controls: learn, put on, tune, each with what it needs."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QGridLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.display import label
from rotemina.plugins.compensation.trial import Help
from rotemina.plugins.compensation.words import LIVE_LOOP
from rotemina.sim.robot.model import PiezoAxis, Robot

_LEFT = dict(zip(Help, ("Without", "Inverse", "Feedback", "Both"), strict=True))


class Controls(QWidget):
    """Choices and buttons; what they ask for is done by the panel."""

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self.axis = QComboBox()
        self.axis.setAccessibleName("Axis")
        self.axis.setToolTip("Piezo axis in open loop that is compensated")
        for name, axis in robot.axes.items():
            if isinstance(axis, PiezoAxis) and axis.controller is None:
                self.axis.addItem(label(name), name)
        self.simulate, self.record = QPushButton("Simulator"), QPushButton("Last record")
        self.files, self.open, self.save = (
            QPushButton(text) for text in ("Records …", "Open …", "Save …")
        )
        self.kind = QComboBox()
        self.kind.setAccessibleName("Which inverse is put on")
        self.kind.setToolTip("Which of the trained inverses is put on")
        self.switch, self.trial = QPushButton("Put on"), QPushButton("Try it")
        self.switch.setProperty("primary", True)
        self.sweep = QPushButton("Sweep")
        self.residuals = {one: _told("") for one in Help}
        self.beyond = _told("")
        self.tune, self.open_gains = QPushButton("Tune"), QPushButton("Open …")
        self.keep, self.apply = QPushButton("Keep …"), QPushButton("Apply point")
        self.generations = QSpinBox()
        self.generations.setRange(1, 500)
        self.generations.setValue(50)
        self.generations.setAccessibleName("Generations of 60 individuals")
        self.generations.setToolTip("1 to 500 generations of 60 individuals each")
        self.forward = QCheckBox("through the inverse")
        self.forward.setToolTip("Feed the reference forward through the inverse in hand")
        self.stop = QPushButton("Stop")
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.doing, self.point = _told(""), _told("")
        self._lay_out()

    @property
    def chosen(self) -> str:
        """The axis; empty where the robot has no piezo in open loop."""
        return self.axis.currentData() or ""

    def tell(self, text: str, share: float | None) -> None:
        """Say what is done, and how much of it."""
        self.doing.setText(text)
        self.progress.setVisible(share is not None)
        self.progress.setValue(round(1000.0 * (share or 0.0)))

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setSpacing(5)
        rows: tuple[tuple[tuple[QWidget, int], ...], ...] = (
            ((_plain("Axis"), 1), (self.axis, 2)),
            ((_head("Learn from"), 3),),
            ((self.simulate, 1), (self.record, 1), (self.files, 1)),
            ((self.open, 1), (self.save, 1)),
            ((_head("Feed-forward"), 3),),
            ((self.kind, 3),),
            ((self.switch, 1), (self.sweep, 1), (self.trial, 1)),
            ((_head("Feedback"), 3),),
            ((self.tune, 1), (self.generations, 1)),
            ((self.forward, 3),),
            ((self.point, 3),),
            ((self.apply, 1), (self.keep, 1), (self.open_gains, 1)),
            ((_head("What is left of the error on a trial"), 3),),
            *(((_plain(_LEFT[one]), 1), (told, 2)) for one, told in self.residuals.items()),
            ((self.beyond, 3),),
        )
        for number, row in enumerate(rows):
            column = 0
            for widget, span in row:
                grid.addWidget(widget, number, column, 1, span)
                column += span
        remark = _told(LIVE_LOOP)
        remark.setProperty("quiet", True)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 4, 0)
        whole.addLayout(grid)
        whole.addWidget(remark)
        for widget in (self.doing, self.progress, self.stop):
            whole.addWidget(widget)
        whole.addStretch(1)


def _told(text: str) -> QLabel:
    label_ = QLabel(text)
    label_.setTextFormat(Qt.TextFormat.PlainText)
    label_.setWordWrap(True)
    return label_


def _plain(text: str) -> QLabel:
    return QLabel(text)


def _head(text: str) -> QLabel:
    head = QLabel(text)
    head.setProperty("heading", True)
    return head
