"""Question about a record: its analysis, an axis, a pair of taps, and settings."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Literal

import numpy as np

from rotemina.plugins.identification import mark, tr
from rotemina.sim.errors import IdentificationError
from rotemina.sim.identification import ExperimentSignals, signals_from_record
from rotemina.sim.records import (
    VOLTAGE_TAPS,
    Record,
    Tap,
)
from rotemina.sim.robot import Robot

INPUT_TAPS = (Tap.CMD, Tap.U, Tap.REF)
OUTPUT_TAPS = (Tap.MEAS, Tap.REF, Tap.U)
_HELD_TAPS = frozenset({Tap.CMD, Tap.U})
_MOTION_TAPS = frozenset({Tap.REF, Tap.MEAS})


class AnalysisView(StrEnum):
    """View of the panel. The value is its name in files."""

    FREQUENCY = mark("Frequency response")
    LOOP = mark("Loop")
    STEPS = mark("Steps")
    MODEL = mark("Fitted model")
    HEALTH = mark("Health card")


@dataclass(frozen=True, slots=True, eq=False)
class AnalysisQuestion:
    """Question about one axis of a record: its input and output tap, and settings.

    Attributes
    ----------
    name : name of the record.
    record : the measured record.
    robot : robot whose nominal model is compared with the record.
    axis, input_tap, output_tap : the axis, and the pair of taps to analyse.
    averages : number of segments of Welch's method.
    method : method of fitting the model, output error or ARX.
    poles : number of poles of the fitted model.
    folder : settings folder in which health cards are stored.
    """

    name: str
    record: Record
    robot: Robot
    axis: str
    input_tap: Tap
    output_tap: Tap
    averages: int = 8
    method: Literal["oe", "arx"] = "oe"
    poles: int = 2
    folder: Path | None = None

    @property
    def lag_samples(self) -> int:
        """Smallest possible delay of the output relative to the input, in samples.

        A command is held from its own row on, and the sensor is read just before the next row.
        """
        return 1 if self.input_tap in _HELD_TAPS and self.output_tap in _MOTION_TAPS else 0

    def unit(self, tap: Tap) -> str:
        """Return the SI unit of a tap of the axis."""
        return "V" if tap in VOLTAGE_TAPS else self.record.units[self.axis]

    def signals(self) -> ExperimentSignals:
        """Return the input and the output of the record.

        Raises
        ------
        IdentificationError
            If both are the same tap, the record lacks one, or its rows are not equally spaced.
        """
        self.check_pair()
        return signals_from_record(
            self.record, [(self.axis, self.input_tap)], [(self.axis, self.output_tap)]
        )

    def check_pair(self) -> None:
        """Check that input and output differ, and that the record contains both.

        Raises
        ------
        IdentificationError
            If they are the same tap, or the record lacks one.
        """
        if self.input_tap == self.output_tap:
            raise IdentificationError(
                tr("{axis}: input and output are both {tap}; choose two different signals").format(
                    axis=self.axis, tap=self.input_tap
                )
            )
        for tap in (self.input_tap, self.output_tap):
            if not self.record.has(self.axis, tap):
                raise IdentificationError(
                    tr("{axis}: the record has no {axis}.{tap}; it has {columns}").format(
                        axis=self.axis, tap=tap, columns=", ".join(map(str, self.record.columns))
                    )
                )


def find_taps(record: Record, axis: str) -> tuple[tuple[Tap, ...], tuple[Tap, ...]]:
    """Return the input taps and the output taps of an axis in a record, preferred ones first."""
    return (
        tuple(tap for tap in INPUT_TAPS if record.has(axis, tap)),
        tuple(tap for tap in OUTPUT_TAPS if record.has(axis, tap)),
    )


def find_first_axis(record: Record) -> str:
    """Return the first axis whose input changes, or the first axis if there is no such axis."""
    for axis in record.axes:
        inputs, outputs = find_taps(record, axis)
        if inputs and outputs and np.ptp(record.signal(axis, inputs[0])) > 0.0:
            return axis
    return record.axes[0]
