"""Measurements, and responses of the models that are recomputed from the fitted effects."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.intake import split_at_leaps
from rotemina.sim.gap.result import Diagnosis
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Axis


@dataclass(frozen=True, slots=True, eq=False)
class GapTrace:
    """One record, or a piece between time leaps, at one tap of one axis; signals (n,), SI.

    Attributes
    ----------
    number : int
        Number of the record among the diagnosed records, from 0.
    record : Record
    axis, tap
    real, raw, corrected : (n,)
        The measurement, and the responses of the original and of the corrected model. A response is
        shifted to the mean of the measurement. If the history is unknown, it starts with the state
        of hysteresis and creep that fits best.
    floor : float
        Rms of the noise floor, which no model can explain.
    described : Axis, optional
        The axis in the robot file.
    """

    number: int
    record: Record
    axis: str
    tap: Tap
    real: FloatArray
    raw: FloatArray
    corrected: FloatArray
    floor: float
    axis_model: Axis | None = None

    @property
    def time_s(self) -> FloatArray:
        """Time since the first row (n,)."""
        return np.asarray(self.record.time_s - self.record.time_s[0])

    @property
    def command(self) -> FloatArray:
        """The command (n,) of the axis, SI."""
        return self.record.signal(self.axis, Tap.CMD)

    @property
    def unit(self) -> str:
        """SI unit of the signals."""
        return "V" if self.tap is Tap.U else self.record.units[self.axis]

    @property
    def is_corrected(self) -> bool:
        """Whether the response of the corrected model differs from that of the original model."""
        return not np.array_equal(self.corrected, self.raw)

    @property
    def gap_before(self) -> FloatArray:
        """The gap (n,) of the original model."""
        return self.real - self.raw

    @property
    def gap_after(self) -> FloatArray:
        """The gap (n,) of the corrected model."""
        return self.real - self.corrected


def compute_traces(
    diagnosis: Diagnosis, axis: str, records: Sequence[Record]
) -> tuple[GapTrace, ...]:
    """Return a trace for each record and tap at which an axis was measured, in record order.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    traces: list[GapTrace] = []
    for record, number in (
        (labelled.record, labelled.number) for labelled in split_at_leaps(records)
    ):
        try:
            evidence = Evidence.of(diagnosis.robot, axis, [record])
        # The axis was not measured in this record.
        except GapError:
            continue
        (observation,) = evidence.observations
        (raw,) = evidence.remembering()
        (corrected,) = evidence.remembering(diagnosis.fitted) if diagnosis.fitted else (raw,)
        for tap, real in observation.real.items():
            responses = _shift_to_mean(real, raw[tap]), _shift_to_mean(real, corrected[tap])
            floor = observation.floor[tap]
            axis_model = diagnosis.robot.axes[axis]
            traces.append(GapTrace(number, record, axis, tap, real, *responses, floor, axis_model))
    return tuple(traces)


def _shift_to_mean(real: FloatArray, response: FloatArray) -> FloatArray:
    return np.asarray(response + (real - response).mean())
