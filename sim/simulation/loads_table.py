"""Files of joint loads: a plain table for spreadsheets and other programs, not a record."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from os import PathLike, fspath
from typing import BinaryIO

from rotemina.sim.plant import JointLoads, Plant
from rotemina.sim.records import open_export, write_columns

_MOTION_UNIT_SUFFIXES = {"position": "", "velocity": "/s", "acceleration": "/s2"}
_FORCE_NAMES = (
    "inertia",
    "damping",
    "stiffness",
    "actuation",
    "constant",
    "perturbation",
    "rest",
    "impulse",
)
_ENERGY_NAMES = ("kinetic_energy", "elastic_energy")


class LoadsTable:
    """Table of comma-separated values with headings such as ``x velocity [m/s]``, in SI units.

    Static axes have no columns of forces.
    """

    def __init__(self, file: BinaryIO, plant: Plant, units: Mapping[str, str]) -> None:
        self._file = file
        self._axes = [(name, axis.static) for name, axis in plant.robot.axes.items()]
        headings = ["t [s]"]
        for name, static in self._axes:
            headings += _list_headings(name, units.get(name) or "m", static=static)
        headings += [f"{name.replace('_', ' ')} [J]" for name in _ENERGY_NAMES]
        file.write((",".join(headings) + "\n").encode())

    def add(self, loads: JointLoads) -> None:
        """Write the rows of ``loads`` after the previous ones."""
        columns = [loads.time_s]
        for number, (_, static) in enumerate(self._axes):
            names = _list_columns(static=static)
            columns += [getattr(loads, name)[:, number] for name in names]
        columns += [getattr(loads, name) for name in _ENERGY_NAMES]
        write_columns(self._file, columns)


@contextmanager
def open_loads_table(
    path: str | PathLike[str], plant: Plant, units: Mapping[str, str]
) -> Iterator[LoadsTable]:
    """Open a table of loads that is written atomically, and compressed if it ends in ``.gz``.

    Parameters
    ----------
    path : path-like
    plant : Plant
        Its axes give the columns.
    units : mapping of axis to "m" or "rad"
        Axes that are not listed have the unit m.

    Raises
    ------
    RecordError
        If the file cannot be written.
    """
    with open_export(fspath(path)) as file:
        yield LoadsTable(file, plant, units)


def _list_columns(*, static: bool) -> Sequence[str]:
    return (*_MOTION_UNIT_SUFFIXES, *(() if static else _FORCE_NAMES))


def _list_headings(axis: str, unit: str, *, static: bool) -> list[str]:
    force_unit = "N" if unit == "m" else "N m"
    units = {name: f"{unit}{per}" for name, per in _MOTION_UNIT_SUFFIXES.items()}
    units |= dict.fromkeys(_FORCE_NAMES, force_unit) | {"impulse": f"{force_unit} s"}
    return [f"{axis} {name} [{units[name]}]" for name in _list_columns(static=static)]
