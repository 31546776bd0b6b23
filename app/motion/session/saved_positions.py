"""Named positions of one robot."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.errors import SavedPositionError
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    TomlFormat,
    make_plain_name,
)
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.messages import message
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import check_target

POSITIONS_FOLDER = "positions"
MAX_POSITION_COUNT, MAX_NAME_LENGTH = 200, 40
#: Names of positions with their own buttons.
HOME, LOAD, WORK = "home", "load", "work"

Name = Annotated[str, Field(strict=True, min_length=1, max_length=MAX_NAME_LENGTH)]
AxisPositions = Mapping[NonEmptyText, Annotated[float, Field(strict=True, allow_inf_nan=False)]]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class PositionsFile:
    """Contents of a file: the positions of one robot, m or rad, by name and axis."""

    robot: NonEmptyText
    positions: Annotated[dict[Name, AxisPositions], Field(max_length=MAX_POSITION_COUNT)] = Field(
        default_factory=dict
    )


_FORMAT = TomlFormat(PositionsFile, {}, SavedPositionError)


class SavedPositions:
    """Named positions of all axes of one robot, stored in a file in the user's folder.

    An invalid file is neither used nor overwritten, until it is repaired or removed.

    Parameters
    ----------
    folder : Path
        The user's folder.
    robot : Robot
    """

    def __init__(self, folder: Path, robot: Robot) -> None:
        self._robot = robot
        self.path = folder / POSITIONS_FOLDER / f"{make_plain_name(robot.name)}.toml"
        self._positions: dict[str, Mapping[str, float]] = {}

    @property
    def positions(self) -> Mapping[str, Mapping[str, float]]:
        """The positions by name, as last read or written."""
        return MappingProxyType(self._positions)

    def read(self) -> None:
        """Read the file. A robot without a file has no positions; an invalid file gives none.

        Raises
        ------
        SavedPositionError
            If the file is invalid. The message names file, position, axis, value and bound.
        """
        self._positions = {}
        if not self.path.exists():
            return
        content = _FORMAT.load(self.path)
        if content.robot != self._robot.name:
            raise SavedPositionError(
                "{path}: the positions belong to robot {robot}, not to {name}; move the file away",
                path=self.path,
                robot=repr(content.robot),
                name=repr(self._robot.name),
            )
        for name, position in content.positions.items():
            self._check(name, position, f"{self.path}: ")
        self._positions = {
            name: MappingProxyType(dict(position)) for name, position in content.positions.items()
        }

    def save(self, name: str, position: Mapping[str, float]) -> None:
        """Save a position under a name, replacing an existing one.

        Raises
        ------
        SavedPositionError
            If the name or the position is invalid, or the file on the disk cannot be used.
        FileWriteError
            If the file cannot be written; then nothing has changed.
        """
        self._check(name, position, "")
        self.read()
        if name not in self._positions and len(self._positions) >= MAX_POSITION_COUNT:
            raise SavedPositionError(
                "{most} positions, the maximum, are saved; delete some", most=MAX_POSITION_COUNT
            )
        self._write({**self._positions, name: MappingProxyType(dict(position))})

    def delete(self, name: str) -> None:
        """Delete a position.

        Raises
        ------
        SavedPositionError
            If no position has this name, or the file on the disk cannot be used.
        FileWriteError
            If the file cannot be written; then nothing has changed.
        """
        self.read()
        if name not in self._positions:
            raise SavedPositionError("there is no position {name}", name=repr(name))
        remaining = {key: position for key, position in self._positions.items() if key != name}
        self._write(remaining)

    def _write(self, positions: dict[str, Mapping[str, float]]) -> None:
        plain_positions: dict[str, Mapping[str, float]] = {
            name: dict(position) for name, position in positions.items()
        }
        _FORMAT.save(self.path, PositionsFile(robot=self._robot.name, positions=plain_positions))
        self._positions = positions

    def _check(self, name: str, position: Mapping[str, float], prefix: str) -> None:
        if not 0 < len(name) <= MAX_NAME_LENGTH or not name.isprintable() or name != name.strip():
            raise SavedPositionError(
                "{where}{name} is not a valid name of a position; use 1 to {longest} "
                "letters without blanks at the ends",
                where=prefix,
                name=repr(name),
                longest=MAX_NAME_LENGTH,
            )
        axes = set(self._robot.axes)
        if set(position) != axes:
            missing, unknown = sorted(axes - set(position)), sorted(set(position) - axes)
            problem = (
                message("engine", "axis {missing} is missing").fill(missing=missing[0])
                if missing
                else message("engine", "there is no axis {other}").fill(other=repr(unknown[0]))
            )
            raise SavedPositionError(
                "{where}position {name}: {what}; it needs {axes}",
                where=prefix,
                name=repr(name),
                what=problem,
                axes=", ".join(self._robot.axes),
            )
        for axis, target in position.items():
            try:
                check_target(self._robot, axis, target)
            except OutOfLimitsError as error:
                raise SavedPositionError(
                    "{where}position {name}: {error}",
                    where=prefix,
                    name=repr(name),
                    error=str(error),
                ) from error
