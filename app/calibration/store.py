"""The calibrations in the user's folder: one file per axis and date, and a list of those in use."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, NamedTuple

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.calibration.files import CALIBRATION_FORMAT, CalibrationFile
from rotemina.app.motion.device import SensorCorrections
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    TomlFormat,
    make_plain_name,
)
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.robot import Robot

CALIBRATIONS_FOLDER, IN_USE_FILE = "calibrations", "in-use.toml"


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class CalibrationsInUse:
    """The name of the calibration file in use, by axis."""

    axes: Annotated[dict[NonEmptyText, NonEmptyText], Field(max_length=200)] = Field(
        default_factory=dict
    )


_IN_USE_FORMAT = TomlFormat(CalibrationsInUse, {}, SensorCalibrationError)


class StoredCalibration(NamedTuple):
    """A calibration in the folder, and whether it is in use."""

    path: Path
    calibration: CalibrationFile
    on: bool


class CalibrationStore:
    """Calibrations of one robot.

    Parameters
    ----------
    folder : Path
        The user's folder.
    robot : Robot
    """

    def __init__(self, folder: Path, robot: Robot) -> None:
        self._robot = robot
        self.folder = folder / CALIBRATIONS_FOLDER / make_plain_name(robot.name)

    def list_calibrations(self) -> tuple[tuple[StoredCalibration, ...], tuple[str, ...]]:
        """Return the stored calibrations, newest first, and the problems of invalid files."""
        try:
            in_use, problems = self._read_in_use(), []
        except SensorCalibrationError as error:
            in_use, problems = {}, [str(error)]
        stored = []
        for path in sorted(self.folder.glob("*.toml")):
            if path.name == IN_USE_FILE:
                continue
            try:
                calibration = self.load(path)
            except SensorCalibrationError as error:
                problems.append(str(error))
                continue
            stored.append(
                StoredCalibration(path, calibration, in_use.get(calibration.axis) == path.name)
            )
        stored.sort(key=lambda entry: entry.calibration.date, reverse=True)
        return tuple(stored), tuple(problems)

    def load(self, path: Path) -> CalibrationFile:
        """Read a calibration.

        Raises
        ------
        SensorCalibrationError
            If it cannot be used, or belongs to another robot or axis.
        """
        calibration = CALIBRATION_FORMAT.load(path)
        axis = self._robot.axes.get(calibration.axis)
        if calibration.robot != self._robot.name or axis is None:
            raise SensorCalibrationError(
                "{path}: the calibration belongs to axis {axis} of robot {robot}, not of "
                "{name}; calibrate this one",
                path=path,
                axis=calibration.axis,
                robot=repr(calibration.robot),
                name=repr(self._robot.name),
            )
        if calibration.unit != (self._robot.unit(calibration.axis) or "m"):
            raise SensorCalibrationError(
                "{path}: unit = {unit}: axis {axis} has another unit",
                path=path,
                unit=repr(calibration.unit),
                axis=calibration.axis,
            )
        return calibration

    def save(self, calibration: CalibrationFile) -> Path:
        """Save a calibration next to earlier ones, and return its path; it is not in use yet.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        name = f"{make_plain_name(calibration.axis)}--{make_plain_name(calibration.date)}"
        path = self.folder / f"{name}.toml"
        CALIBRATION_FORMAT.save(path, calibration)
        return path

    def select(self, axis: str, path: Path | None) -> None:
        """Set which calibration of an axis is in use from now on; None means none.

        Raises
        ------
        SensorCalibrationError, FileWriteError
            If the file cannot be read, or the choice cannot be saved.
        """
        in_use = {name: file for name, file in self._read_in_use().items() if name != axis}
        if path is not None:
            self.load(path)
            in_use[axis] = path.name
        _IN_USE_FORMAT.save(self.folder / IN_USE_FILE, replace(CalibrationsInUse(), axes=in_use))

    def apply(self, corrections: SensorCorrections) -> tuple[str, ...]:
        """Apply only the calibrations in use to a session; return the problems of invalid files."""
        stored, problems = self.list_calibrations()
        in_use = {entry.calibration.axis: entry.calibration for entry in stored if entry.on}
        for axis in self._robot.axes:
            calibration = in_use.get(axis)
            corrections.set_calibration(
                axis, calibration.applied_calibration if calibration is not None else None
            )
        return problems

    def _read_in_use(self) -> dict[str, str]:
        path = self.folder / IN_USE_FILE
        return dict(_IN_USE_FORMAT.load(path).axes) if path.exists() else {}
