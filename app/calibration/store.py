"""The calibrations in a user's folder: one file per axis and date, and which are in use."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, NamedTuple

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.calibration.files import FORMAT, CalibrationFile
from rotemina.app.files import plain_name
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.app.toml_file import STRICT, Format, Text
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

FOLDER, IN_USE = "calibrations", "in-use.toml"


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class InUse:
    """Which file is on, by axis."""

    axes: Annotated[dict[Text, Text], Field(max_length=200)] = Field(default_factory=dict)


_IN_USE = Format(InUse, {}, CalibrationError)


class Stored(NamedTuple):
    """A calibration in the folder, and whether it is on."""

    path: Path
    calibration: CalibrationFile
    on: bool


class CalibrationStore:
    """Calibrations of one robot.

    Parameters
    ----------
    folder : Path
        The user's.
    robot : Robot
    """

    def __init__(self, folder: Path, robot: Robot) -> None:
        self._robot = robot
        self.folder = folder / FOLDER / plain_name(robot.name)

    def listed(self) -> tuple[tuple[Stored, ...], tuple[str, ...]]:
        """Return the stored calibrations, newest first, and the problems of invalid files."""
        try:
            in_use, problems = self._in_use(), []
        except CalibrationError as error:
            in_use, problems = {}, [str(error)]
        found = []
        for path in sorted(self.folder.glob("*.toml")):
            if path.name == IN_USE:
                continue
            try:
                calibration = self.load(path)
            except CalibrationError as error:
                problems.append(str(error))
                continue
            found.append(Stored(path, calibration, in_use.get(calibration.axis) == path.name))
        found.sort(key=lambda one: one.calibration.date, reverse=True)
        return tuple(found), tuple(problems)

    def load(self, path: Path) -> CalibrationFile:
        """Read a calibration.

        Raises
        ------
        CalibrationError
            If it cannot be used, or is of another robot or axis.
        """
        found = FORMAT.load(path)
        axis = self._robot.axes.get(found.axis)
        if found.robot != self._robot.name or axis is None:
            raise CalibrationError(
                message(
                    "engine",
                    "{path}: the calibration belongs to axis {axis} of robot {robot}, not of "
                    "{name}; calibrate this one",
                ).fill(
                    path=path, axis=found.axis, robot=repr(found.robot), name=repr(self._robot.name)
                )
            )
        if found.unit != (self._robot.unit(found.axis) or "m"):
            raise CalibrationError(
                message("engine", "{path}: unit = {unit}: axis {axis} has another unit").fill(
                    path=path, unit=repr(found.unit), axis=found.axis
                )
            )
        return found

    def save(self, calibration: CalibrationFile) -> Path:
        """Keep a calibration beside the earlier ones; return where. It is not on yet.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        name = f"{plain_name(calibration.axis)}--{plain_name(calibration.date)}"
        path = self.folder / f"{name}.toml"
        FORMAT.save(path, calibration)
        return path

    def switch(self, axis: str, path: Path | None) -> None:
        """Keep which calibration of an axis is on from now on; None: none.

        Raises
        ------
        CalibrationError, FileWriteError
            If the file cannot be read, or the choice not be kept.
        """
        kept = {name: file for name, file in self._in_use().items() if name != axis}
        if path is not None:
            self.load(path)
            kept[axis] = path.name
        _IN_USE.save(self.folder / IN_USE, replace(InUse(), axes=kept))

    def apply(self, corrections: SensorCorrections) -> tuple[str, ...]:
        """Apply the calibrations in use to a session, and no others; return problems of files."""
        stored, problems = self.listed()
        on = {one.calibration.axis: one.calibration for one in stored if one.on}
        for axis in self._robot.axes:
            found = on.get(axis)
            corrections.use(axis, found.applied if found is not None else None)
        return problems

    def _in_use(self) -> dict[str, str]:
        path = self.folder / IN_USE
        return dict(_IN_USE.load(path).axes) if path.exists() else {}
