"""Named positions of one robot."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.files import plain_name
from rotemina.app.toml_file import STRICT, Format, Text
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_target

FOLDER = "positions"
MOST, LONGEST_NAME = 200, 40
#: Names of places that have buttons of their own.
HOME, LOAD, WORK = "home", "load", "work"

Name = Annotated[str, Field(strict=True, min_length=1, max_length=LONGEST_NAME)]
AxisPositions = Mapping[Text, Annotated[float, Field(strict=True, allow_inf_nan=False)]]


class SavedPositionError(InputError):
    """A position that cannot be kept, or a file of positions that cannot be used."""


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class PositionsFile:
    """The positions of one robot; m or rad, by name and axis."""

    robot: Text
    positions: Annotated[dict[Name, AxisPositions], Field(max_length=MOST)] = Field(
        default_factory=dict
    )


_FORMAT = Format(PositionsFile, {}, SavedPositionError)


class SavedPositions:
    """Named positions of one robot, each with all of its axes, in a file of the user's folder.

    An unusable file is left alone: no move uses it and nothing is written until it is repaired or
    removed.

    Parameters
    ----------
    folder : Path
        The user's.
    robot : Robot
    """

    def __init__(self, folder: Path, robot: Robot) -> None:
        self._robot = robot
        self.path = folder / FOLDER / f"{plain_name(robot.name)}.toml"
        self._kept: dict[str, Mapping[str, float]] = {}

    @property
    def kept(self) -> Mapping[str, Mapping[str, float]]:
        """The places by name, as they were read or written last."""
        return MappingProxyType(self._kept)

    def read(self) -> None:
        """Read the file, all of it or nothing; none is a robot without positions.

        Raises
        ------
        SavedPositionError
            With file, name, axis, value and bound.
        """
        self._kept = {}
        if not self.path.exists():
            return
        found = _FORMAT.load(self.path)
        if found.robot != self._robot.name:
            raise SavedPositionError(
                message(
                    "engine",
                    "{path}: the positions belong to robot {robot}, not to {name}; move the "
                    "file away",
                ).fill(path=self.path, robot=repr(found.robot), name=repr(self._robot.name))
            )
        for name, place in found.positions.items():
            self._check(name, place, f"{self.path}: ")
        self._kept = {name: MappingProxyType(dict(at)) for name, at in found.positions.items()}

    def keep(self, name: str, place: Mapping[str, float]) -> None:
        """Save a position under a name, replacing an existing one.

        Raises
        ------
        SavedPositionError
            If the name or the place will not do, or the file on the disk cannot be used.
        FileWriteError
            If it cannot be written; then all is as before.
        """
        self._check(name, place, "")
        self.read()
        if name not in self._kept and len(self._kept) >= MOST:
            raise SavedPositionError(
                message("engine", "{most} positions, the maximum, are saved; delete some").fill(
                    most=MOST
                )
            )
        self._write({**self._kept, name: MappingProxyType(dict(place))})

    def delete(self, name: str) -> None:
        """Delete a position.

        Raises
        ------
        SavedPositionError
            If there is none of that name, or the file on the disk cannot be used.
        FileWriteError
            If it cannot be written; then all is as before.
        """
        self.read()
        if name not in self._kept:
            raise SavedPositionError(
                message("engine", "there is no position {name}").fill(name=repr(name))
            )
        self._write({other: place for other, place in self._kept.items() if other != name})

    def _write(self, kept: dict[str, Mapping[str, float]]) -> None:
        plain: dict[str, Mapping[str, float]] = {name: dict(at) for name, at in kept.items()}
        _FORMAT.save(self.path, PositionsFile(robot=self._robot.name, positions=plain))
        self._kept = kept

    def _check(self, name: str, place: Mapping[str, float], where: str) -> None:
        """Refuse an illegible name, and a position that does not fit this robot."""
        if not 0 < len(name) <= LONGEST_NAME or not name.isprintable() or name != name.strip():
            raise SavedPositionError(
                message(
                    "engine",
                    "{where}{name} is not a valid name of a position; use 1 to {longest} "
                    "letters without blanks at the ends",
                ).fill(where=where, name=repr(name), longest=LONGEST_NAME)
            )
        axes = set(self._robot.axes)
        if set(place) != axes:
            missing, other = sorted(axes - set(place)), sorted(set(place) - axes)
            what = (
                message("engine", "axis {missing} is missing").fill(missing=missing[0])
                if missing
                else message("engine", "there is no axis {other}").fill(other=repr(other[0]))
            )
            raise SavedPositionError(
                message("engine", "{where}position {name}: {what}; it needs {axes}").fill(
                    where=where, name=repr(name), what=what, axes=", ".join(self._robot.axes)
                )
            )
        for axis, at in place.items():
            try:
                check_target(self._robot, axis, at)
            except OutOfLimitsError as error:
                raise SavedPositionError(
                    message("engine", "{where}position {name}: {error}").fill(
                        where=where, name=repr(name), error=str(error)
                    )
                ) from error
