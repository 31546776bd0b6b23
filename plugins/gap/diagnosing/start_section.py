"""Section to start a diagnosis: the records, the model, the buttons and the progress."""

from PySide6.QtWidgets import QBoxLayout, QFrame, QLabel, QProgressBar, QPushButton, QSizePolicy

from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosing.record_selection import RecordSelection
from rotemina.plugins.gap.diagnosing.record_views import RecordList, RecordMenu
from rotemina.plugins.gap.diagnosing.robot_choice import RobotChoice

# Width of the section when it is at the side of the page.
RAIL_WIDTH_PX = 320

# A taller list would move the widgets below it too far down.
_MAX_LIST_HEIGHT_PX = 400


class StartSection(QFrame):
    """Section that is a column at the left of a large page, or a row at the top of a small one."""

    def __init__(self, workbench: Workbench, records: RecordSelection) -> None:
        super().__init__()
        self.setObjectName("rail")
        self.menu = RecordMenu(workbench, records)
        self.list = RecordList(records)
        self.list.setMaximumHeight(_MAX_LIST_HEIGHT_PX)
        self.robots = RobotChoice(workbench)
        self.start = QPushButton(tr("Diagnose"))
        self.start.setProperty("primary", True)
        self.stop = QPushButton(tr("Stop"))
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.doing = make_plain_label(quiet=False, wrap=True)
        self._model_label = QLabel(tr("Model"))
        self._layout = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(6)
        for widget in (self.menu, self.list, self._model_label, self.robots):
            self._layout.addWidget(widget)
        self._layout.addLayout(make_row(self.start, self.stop))
        self._layout.addWidget(self.progress)
        self._layout.addWidget(self.doing, 1)
        self._layout.addStretch(0)
        self.upright = True
        self.set_upright(upright=False)

    def set_upright(self, *, upright: bool) -> None:
        """Lay the widgets out as a column at the side of the page, or as a row above it."""
        if upright is self.upright:
            return
        self.upright = upright
        direction = QBoxLayout.Direction
        self._layout.setDirection(direction.TopToBottom if upright else direction.LeftToRight)
        for widget in (self.list, self._model_label):
            widget.setVisible(upright)
        self.progress.setMaximumWidth(RAIL_WIDTH_PX if upright else 160)
        policy = QSizePolicy.Policy.Expanding if upright else QSizePolicy.Policy.Maximum
        self.start.setSizePolicy(policy, QSizePolicy.Policy.Fixed)
        if upright:
            self.setFixedWidth(RAIL_WIDTH_PX)
        else:
            self.setMinimumWidth(0)
            # This is Qt's QWIDGETSIZE_MAX, which removes the upper bound.
            self.setMaximumWidth(16_777_215)
        self._layout.setStretch(self._layout.count() - 1, 1 if upright else 0)
        self._layout.setStretchFactor(self.doing, 0 if upright else 1)
