"""Files of joint loads: a plain table for spreadsheets and other programs, which is no record."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from os import PathLike, fspath
from typing import BinaryIO

from rotemina.sim.plant.joint_loads import JointLoads
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.writing import open_export

_MOTIONS = {"position": "", "velocity": "/s", "acceleration": "/s2"}
_FORCES = (
    "inertia",
    "damping",
    "stiffness",
    "actuation",
    "constant",
    "perturbation",
    "rest",
    "impulse",
)
_ENERGIES = ("kinetic_energy", "elastic_energy")


class LoadsTable:
    """A table of comma-separated values with a heading, such as ``x velocity [m/s]``, SI units.

    Static axes have no columns of forces.
    """

    def __init__(self, file: BinaryIO, plant: Plant, units: Mapping[str, str]) -> None:
        self._file = file
        self._axes = [(name, axis.static) for name, axis in plant.robot.axes.items()]
        headings = ["t [s]"]
        for name, static in self._axes:
            headings += _headings(name, units.get(name) or "m", static=static)
        headings += [f"{name.replace('_', ' ')} [J]" for name in _ENERGIES]
        file.write((",".join(headings) + "\n").encode())

    def add(self, loads: JointLoads) -> None:
        """Write the rows of ``loads`` behind those before."""
        import polars as pl  # takes its time to import; who writes no table goes without

        columns = [loads.time_s]
        for number, (_, static) in enumerate(self._axes):
            names = _columns(static=static)
            columns += [getattr(loads, name)[:, number] for name in names]
        columns += [getattr(loads, name) for name in _ENERGIES]
        table = pl.DataFrame({str(index): column for index, column in enumerate(columns)})
        table.write_csv(self._file, include_header=False)


@contextmanager
def loads_table(
    path: str | PathLike[str], plant: Plant, units: Mapping[str, str]
) -> Iterator[LoadsTable]:
    """Open a table of loads, which appears complete or not at all; ``.gz`` is compressed.

    Parameters
    ----------
    path : of the file.
    plant : whose axes have the columns.
    units : mapping axis -> "m" or "rad"; m where left out.

    Raises
    ------
    RecordError
        If the file cannot be written.
    """
    with open_export(fspath(path)) as file:
        yield LoadsTable(file, plant, units)


def _columns(*, static: bool) -> Sequence[str]:
    return (*_MOTIONS, *(() if static else _FORCES))


def _headings(axis: str, unit: str, *, static: bool) -> list[str]:
    force = "N" if unit == "m" else "N m"
    units = {name: f"{unit}{per}" for name, per in _MOTIONS.items()}
    units |= dict.fromkeys(_FORCES, force) | {"impulse": f"{force} s"}
    return [f"{axis} {name} [{units[name]}]" for name in _columns(static=static)]
