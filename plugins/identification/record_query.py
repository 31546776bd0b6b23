"""The operator's query of a record: axis, pair of taps, and view."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from rotemina.plugins.identification import tr
from rotemina.sim.identification.errors import IdentificationError
from rotemina.sim.identification.experiment_signals import Signals, signals_of
from rotemina.sim.records.record import VOLTAGE_TAPS, Record, Tap
from rotemina.sim.robot.model import Robot

INPUTS = (Tap.CMD, Tap.U, Tap.REF)
OUTPUTS = (Tap.MEAS, Tap.REF, Tap.U)  # in the order in which they are offered
_HELD = frozenset({Tap.CMD, Tap.U})
_MOVED = frozenset({Tap.REF, Tap.MEAS})


@dataclass(frozen=True, slots=True, eq=False)
class Question:
    """A record, one axis of it, and the taps of input and output.

    Attributes
    ----------
    name : of the record, as the operator knows it.
    record : what was measured.
    robot : whose nominal model is drawn beside it.
    axis, drive, answer : input and output.
    averages : segments that Welch's method averages over.
    method : of the fitted model.
    poles : of the fitted model.
    folder : the user's, where health cards are kept.
    """

    name: str
    record: Record
    robot: Robot
    axis: str
    drive: Tap
    answer: Tap
    averages: int = 8
    method: Literal["oe", "arx"] = "oe"
    poles: int = 2
    folder: Path | None = None

    @property
    def lag_samples(self) -> int:
        """By how many samples an output shows later than its input at the soonest.

        A command is held from its row on, and the sensor is read just before the next one.
        """
        return 1 if self.drive in _HELD and self.answer in _MOVED else 0

    def unit(self, tap: Tap) -> str:
        """Return the SI unit of a tap of the axis."""
        return "V" if tap in VOLTAGE_TAPS else self.record.units[self.axis]

    def signals(self) -> Signals:
        """Take input and output out of the record.

        Raises
        ------
        IdentificationError
            If both are the same tap, the record lacks one, or its rows are not equally spaced.
        """
        self.check()
        return signals_of(self.record, [(self.axis, self.drive)], [(self.axis, self.answer)])

    def check(self) -> None:
        """Refuse an invalid pair, or one that the record lacks.

        Raises
        ------
        IdentificationError
        """
        if self.drive == self.answer:
            raise IdentificationError(
                tr("{axis}: input and output are both {tap}; choose two different signals").format(
                    axis=self.axis, tap=self.drive
                )
            )
        for tap in (self.drive, self.answer):
            if not self.record.has(self.axis, tap):
                raise IdentificationError(
                    tr("{axis}: the record has no {axis}.{tap}; it has {columns}").format(
                        axis=self.axis, tap=tap, columns=", ".join(map(str, self.record.columns))
                    )
                )


def taps_of(record: Record, axis: str) -> tuple[tuple[Tap, ...], tuple[Tap, ...]]:
    """Return the inputs and the outputs that a record offers for an axis, the best first."""
    return (
        tuple(tap for tap in INPUTS if record.has(axis, tap)),
        tuple(tap for tap in OUTPUTS if record.has(axis, tap)),
    )


def first_axis(record: Record) -> str:
    """Return the first axis whose input moves, or the first of all where none does."""
    for axis in record.axes:
        inputs, outputs = taps_of(record, axis)
        if inputs and outputs and np.ptp(record.signal(axis, inputs[0])) > 0.0:
            return axis
    return record.axes[0]
