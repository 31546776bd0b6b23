"""Measurements and answers of the models, recomputed from the effects found."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.intake.time_leaps import pieces
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """One record, or a piece between leaps of time, at one tap of one axis; signals (n,), SI.

    Attributes
    ----------
    number : int
        Of the record among those that were diagnosed, from 0.
    record : Record
    axis, tap
    real, raw, corrected : (n,)
        What was measured; the answers of the model as it was and with what was found. The mean
        distance of an answer from what was measured is taken out, and where the history is unknown
        the axis remembers what suits the record best: both are nuisances.
    floor : float
        Rms of what no model can explain.
    described : Axis, optional
        The axis as the robot file has it.
    """

    number: int
    record: Record
    axis: str
    tap: Tap
    real: FloatArray
    raw: FloatArray
    corrected: FloatArray
    floor: float
    described: Axis | None = None

    @property
    def time_s(self) -> FloatArray:
        """From the first row on, (n,)."""
        return np.asarray(self.record.time_s - self.record.time_s[0])

    @property
    def command(self) -> FloatArray:
        """The axis' command (n,), SI."""
        return self.record.signal(self.axis, Tap.CMD)

    @property
    def unit(self) -> str:
        """SI unit of the signals."""
        return "V" if self.tap is Tap.U else self.record.units[self.axis]

    @property
    def changed(self) -> bool:
        """Whether anything was found that corrects the model of this axis."""
        return not np.array_equal(self.corrected, self.raw)

    @property
    def before(self) -> FloatArray:
        """The gap (n,) of the model as it was."""
        return self.real - self.raw

    @property
    def after(self) -> FloatArray:
        """The gap (n,) of the corrected model."""
        return self.real - self.corrected


def traces(diagnosis: Diagnosis, axis: str, records: Sequence[Record]) -> tuple[Trace, ...]:
    """Return every record and tap that speaks of an axis, records in their order.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    found: list[Trace] = []
    for record, number in ((one.record, one.number) for one in pieces(records)):
        try:
            evidence = Evidence.of(diagnosis.robot, axis, [record])
        except GapError:
            continue  # this record does not measure the axis
        (observation,) = evidence.observations
        (raw,) = evidence.remembering()
        (corrected,) = evidence.remembering(diagnosis.fitted) if diagnosis.fitted else (raw,)
        for tap, real in observation.real.items():
            answers = _beside(real, raw[tap]), _beside(real, corrected[tap])
            floor = observation.floor[tap]
            described = diagnosis.robot.axes[axis]
            found.append(Trace(number, record, axis, tap, real, *answers, floor, described))
    return tuple(found)


def _beside(real: FloatArray, answer: FloatArray) -> FloatArray:
    """Return an answer shifted to the mean of the measurement."""
    return np.asarray(answer + (real - answer).mean())
