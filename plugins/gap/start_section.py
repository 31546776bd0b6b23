"""What a diagnosis is made of: records, model, its start, and how far it is."""

from PySide6.QtWidgets import QBoxLayout, QFrame, QLabel, QProgressBar, QPushButton, QSizePolicy

from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.record_views import RecordList, RecordMenu
from rotemina.plugins.gap.records import Records
from rotemina.plugins.gap.robot_choice import RobotChoice

WIDTH = 320  # px, upright
_HIGH = 400  # px of the list, at most: what follows stays near it


class StartSection(QFrame):
    """A column at the left of a large page, a row above a small one."""

    def __init__(self, workbench: Workbench, records: Records) -> None:
        super().__init__()
        self.setObjectName("rail")
        self.menu = RecordMenu(workbench, records)
        self.list = RecordList(records)
        self.list.setMaximumHeight(_HIGH)
        self.robots = RobotChoice(workbench)
        self.start = QPushButton(tr("Diagnose"))
        self.start.setProperty("primary", True)
        self.stop = QPushButton(tr("Stop"))
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.doing = plain_text(quiet=False, wrap=True)
        self._model = QLabel(tr("Model"))
        self._line = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._line.setContentsMargins(0, 0, 0, 0)
        self._line.setSpacing(6)
        for widget in (self.menu, self.list, self._model, self.robots):
            self._line.addWidget(widget)
        self._line.addLayout(in_row(self.start, self.stop))
        self._line.addWidget(self.progress)
        self._line.addWidget(self.doing, 1)
        self._line.addStretch(0)
        self.upright = True
        self.stand(upright=False)

    def stand(self, *, upright: bool) -> None:
        """Stand upright at the side of the page, or lie above it."""
        if upright is self.upright:
            return
        self.upright = upright
        way = QBoxLayout.Direction
        self._line.setDirection(way.TopToBottom if upright else way.LeftToRight)
        for widget in (self.list, self._model):
            widget.setVisible(upright)
        self.progress.setMaximumWidth(WIDTH if upright else 160)
        wide = QSizePolicy.Policy.Expanding if upright else QSizePolicy.Policy.Maximum
        self.start.setSizePolicy(wide, QSizePolicy.Policy.Fixed)
        if upright:
            self.setFixedWidth(WIDTH)
        else:
            self.setMinimumWidth(0)
            self.setMaximumWidth(16_777_215)  # Qt's largest
        self._line.setStretch(self._line.count() - 1, 1 if upright else 0)
        self._line.setStretchFactor(self.doing, 0 if upright else 1)
