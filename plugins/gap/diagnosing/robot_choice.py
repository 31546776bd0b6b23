"""Choice of the model to diagnose: nominal, in use, of a shipped robot, or from a file."""

from pathlib import Path
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox

from rotemina.app.motion.model import ModelInUse
from rotemina.app.shell.records import ask_file
from rotemina.app.workbench import Workbench
from rotemina.plugins.gap import tr
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import list_shipped_robots, load_robot

_FILE_ITEM, _REMAINDER_ITEM = object(), object()


class RobotChoice(QComboBox):
    """Choice of the robot whose model is diagnosed.

    If a robot cannot be loaded, a notice appears and the previous choice is kept.

    Signals
    -------
    changed(Robot) : another robot was chosen and loaded.
    """

    changed = Signal(object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.robot: Robot = workbench.robot
        # Name or file from which the robot was loaded, or None for the robot in use.
        self.source: str | Path | None = None
        self._loaded_index = 0
        self.setAccessibleName(tr("Model"))
        self.setToolTip(tr("Model to be diagnosed; initially the nominal one"))
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(17)
        # In a narrow window the name is elided, so that the rest of the row stays visible.
        self.setMinimumWidth(80)
        nominal_text = tr("{robot}, nominal").format(robot=workbench.robot.name)
        self.addItem(nominal_text, None)
        self.addItem(tr("Remainder of the model in use"), _REMAINDER_ITEM)
        for name in list_shipped_robots():
            self.addItem(name, name)
        self.addItem(tr("Robot file …"), _FILE_ITEM)
        self.activated.connect(self._choose)
        workbench.model_changed.connect(self._follow_model)

    def load(self, source: str | Path | None) -> None:
        """Load a robot: None for the robot in use, the name of a shipped robot, or a file."""
        if source is None:
            self._use_robot(None, self._workbench.robot)
            return
        self._workbench.read_file(
            "gap robot",
            source,
            lambda: load_robot(source),
            lambda robot: self._use_robot(source, robot),
        )

    def _choose(self, index: int) -> None:
        source = self.itemData(index)
        # The previous choice is kept until the new robot is loaded.
        self.setCurrentIndex(self._loaded_index)
        if source is _FILE_ITEM:
            self._ask_file()
        elif source is _REMAINDER_ITEM:
            self._use_robot(source, self._workbench.session.model.robot)
        else:
            self.load(source)

    def _use_robot(self, source: Any, robot: Robot) -> None:
        if isinstance(source, Path) and self.findData(source) < 0:
            self.insertItem(self.count() - 1, source.name, source)
        self._loaded_index = self.findData(source)
        self.setCurrentIndex(self._loaded_index)
        self.source = None if source is _REMAINDER_ITEM else source
        self.robot = robot
        self.changed.emit(robot)

    def _follow_model(self, model: ModelInUse) -> None:
        if self.itemData(self._loaded_index) is not _REMAINDER_ITEM:
            return
        if model.is_corrected:
            self._use_robot(_REMAINDER_ITEM, model.robot)
        else:
            self.load(None)

    def _ask_file(self) -> None:
        title, file_filter = tr("Robot file"), tr("Robot files (*.toml)")
        ask_file(self.window(), self._workbench, title, file_filter, self.load)
