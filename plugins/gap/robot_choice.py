"""The model that is to be diagnosed: the one in use, a shipped one, or a file's."""

from pathlib import Path
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox

from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.shell.file_dialog import ask_file
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.gap import tr
from rotemina.sim.robot.file import load_robot, shipped_robots
from rotemina.sim.robot.model import Robot

_FILE, _BEYOND = object(), object()


class RobotChoice(QComboBox):
    """Robots by name; one that cannot be loaded becomes a notice, and the last one stays.

    Signals
    -------
    changed(Robot)
    """

    changed = Signal(object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.robot: Robot = workbench.robot
        self.source: str | Path | None = None  # of the robot's text, None for the one in use
        self._place = 0
        self.setAccessibleName(tr("Model"))
        self.setToolTip(tr("Model to be diagnosed; initially the nominal one"))
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(17)
        self.setMinimumWidth(80)  # where the window is narrow, a name is cut rather than the row
        nominal = tr("{robot}, nominal").format(robot=workbench.robot.name)
        self.addItem(nominal, None)
        self.addItem(tr("Remainder of the model in use"), _BEYOND)
        for name in shipped_robots():
            self.addItem(name, name)
        self.addItem(tr("Robot file …"), _FILE)
        self.activated.connect(self._choose)
        workbench.model_changed.connect(self._follow_model)

    def load(self, source: str | Path | None) -> None:
        """Take a robot in hand: the one in use, a shipped one by name, or one of a file."""
        if source is None:
            self._take(None, self._workbench.robot)
            return
        self._workbench.read_file(
            "gap robot", source, lambda: load_robot(source), lambda robot: self._take(source, robot)
        )

    def _choose(self, place: int) -> None:
        source = self.itemData(place)
        self.setCurrentIndex(self._place)  # until it is there
        if source is _FILE:
            self._ask()
        elif source is _BEYOND:
            self._take(source, self._workbench.session.model.robot)
        else:
            self.load(source)

    def _take(self, source: Any, robot: Robot) -> None:
        if isinstance(source, Path) and self.findData(source) < 0:
            self.insertItem(self.count() - 1, source.name, source)
        self._place = self.findData(source)
        self.setCurrentIndex(self._place)
        self.source = None if source is _BEYOND else source
        self.robot = robot
        self.changed.emit(robot)

    def _follow_model(self, model: ModelInUse) -> None:
        """Continue with the model in use where that is what is looked beyond."""
        if self.itemData(self._place) is not _BEYOND:
            return
        if model.corrected:
            self._take(_BEYOND, model.robot)
        else:
            self.load(None)

    def _ask(self) -> None:
        title, kinds = tr("Robot file"), tr("Robot files (*.toml)")
        ask_file(self.window(), self._workbench, title, kinds, self.load)
