"""The TOML file of a sensor calibration, with the date and the records that it was fitted to.

The format is strict: unknown keys are rejected.
"""

import hashlib
from dataclasses import asdict
from datetime import datetime
from typing import Annotated, Literal

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.motion.device import AppliedCalibration
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    TomlFormat,
)
from rotemina.sim.calibration import (
    MAX_BEND_COEFFICIENTS,
    MAX_LAG_S,
    STOP_RADIUS_SHARES,
    PositioningFigures,
    SensorCalibration,
    SensorLag,
    SensorModel,
)
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.records import Record

VERSION = 1
_DIGEST_BYTES = 8

Finite = Annotated[float, Field(strict=False, allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Count = Annotated[int, Field(strict=True, ge=1)]
Digest = Annotated[str, Field(strict=True, pattern="^[0-9a-f]{16}$")]
NoteLine = Annotated[str, Field(strict=True, max_length=400)]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class SourceRecord:
    """A source record of a calibration, with the digest of its content."""

    name: NonEmptyText
    digest: Digest


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class StoredSensorModel:
    """Parameters of a :class:`rotemina.sim.calibration.SensorModel`, in SI units.

    Attributes
    ----------
    low, high : float
        Ends of the range over which the sensor was calibrated, m or rad.
    offset, gain_error : float
        Error of the line through both ends of the range.
    bend : tuple of float
        Coefficients of the nonlinearity, m or rad.
    radii, weights : tuple of float
        Radius, m or rad, and weight of each stop operator of the hysteresis.
    lag, lag_s : str, float
        Kind of the sensor's lag, and its time.
    period : float
        Period of an encoder's interpolation error, m or rad; 0 for none.
    harmonics : tuple of float
        Sine and cosine amplitudes of the first and of the second harmonic of the interpolation
        error, m or rad.
    """

    low: Finite
    high: Finite
    offset: Finite
    gain_error: Annotated[float, Field(gt=-0.9, lt=10.0)]
    bend: Annotated[tuple[Finite, ...], Field(max_length=MAX_BEND_COEFFICIENTS)] = ()
    radii: Annotated[tuple[Positive, ...], Field(max_length=len(STOP_RADIUS_SHARES))] = ()
    weights: Annotated[tuple[Finite, ...], Field(max_length=len(STOP_RADIUS_SHARES))] = ()
    lag: Literal["none", "first_order", "delay"] = "none"
    lag_s: Annotated[float, Field(ge=0.0, le=MAX_LAG_S)] = 0.0
    period: NotNegative = 0.0
    harmonics: Annotated[tuple[Finite, ...], Field(max_length=4)] = ()

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise ValueError(
                f"low must be less than high; low = {self.low!r}, high = {self.high!r}"
            )
        if len(self.radii) != len(self.weights):
            raise ValueError(f"there are {len(self.radii)} radii, but {len(self.weights)} weights")
        if len(self.harmonics) != (4 if self.period else 0):
            raise ValueError("harmonics must have 4 values with a period, and none without one")

    @property
    def model(self) -> SensorModel:
        """The model that corrects readings."""
        return SensorModel(**(asdict(self) | {"lag": SensorLag(self.lag)}))


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class StoredFigure:
    """A figure with the half-width of its 95 % confidence interval, if it has one."""

    name: NonEmptyText
    value: Finite
    half_width: NotNegative | None = None
    unit: NonEmptyText


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class IsoFigures:
    """Figures of ISO 230-2:2014, m or rad."""

    accuracy: NotNegative
    repeatability: NotNegative
    repeatability_up: NotNegative
    repeatability_down: NotNegative
    reversal: NotNegative
    mean_reversal: Finite
    systematic: NotNegative
    mean_bidirectional: NotNegative

    @property
    def positioning(self) -> PositioningFigures:
        """The figures as a :class:`PositioningFigures`."""
        return PositioningFigures(*(getattr(self, name) for name in PositioningFigures._fields))


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class CalibrationFile:
    """Everything stored for the calibration of one axis.

    Attributes
    ----------
    travel : (float, float)
        Ends of the calibrated travel, in ``unit``.
    runs : int
        Number of calibration runs.
    before_rms, after_rms : float
        rms error of the reading in the validation runs, without and with the calibration.
    iso_reading_before, iso_reading_after : IsoFigures or None
        Figures of the reading, without and with the calibration.
    iso_reached : IsoFigures or None
        Figures of the positions that the axis reached.
    """

    version: Annotated[int, Field(strict=True, ge=VERSION, le=VERSION)] = VERSION
    robot: NonEmptyText
    axis: NonEmptyText
    unit: Literal["m", "rad"]
    date: NonEmptyText
    travel: tuple[Finite, Finite]
    runs: Count
    before_rms: NotNegative
    after_rms: NotNegative
    sensor: StoredSensorModel
    figures: tuple[StoredFigure, ...]
    sources: Annotated[tuple[SourceRecord, ...], Field(min_length=1)]
    notes: tuple[NoteLine, ...] = ()
    iso_reading_before: IsoFigures | None = None
    iso_reading_after: IsoFigures | None = None
    iso_reached: IsoFigures | None = None

    def __post_init__(self) -> None:
        if not self.travel[0] < self.travel[1]:
            raise ValueError(f"travel must increase, not {self.travel!r}")
        try:
            datetime.fromisoformat(self.date)
        except ValueError:
            raise ValueError(f"date must be ISO 8601, not {self.date!r}") from None

    @property
    def name(self) -> str:
        """Date and digest, the label of the calibration in records and on screens."""
        return f"{self.date} {_digest(CALIBRATION_FORMAT.to_toml(self).encode())[:8]}"

    @property
    def applied_calibration(self) -> AppliedCalibration:
        """The calibration in the form that a session applies."""
        return AppliedCalibration(self.name, self.sensor.model, self.travel)


CALIBRATION_FORMAT = TomlFormat(
    CalibrationFile,
    {
        "sensor": StoredSensorModel,
        "figures": StoredFigure,
        "sources": SourceRecord,
        "iso_reading_before": IsoFigures,
        "iso_reading_after": IsoFigures,
        "iso_reached": IsoFigures,
    },
    SensorCalibrationError,
)


def make_calibration_file(
    calibration: SensorCalibration, robot: str, sources: tuple[SourceRecord, ...], date: datetime
) -> CalibrationFile:
    """Return a calibration in the form of its file.

    Raises
    ------
    SensorCalibrationError
        If the calibration must not be used.
    """
    if calibration.refusal is not None:
        raise SensorCalibrationError(calibration.refusal)
    return CalibrationFile(
        robot=robot,
        axis=calibration.axis,
        unit="rad" if calibration.unit == "rad" else "m",
        date=date.isoformat(timespec="seconds"),
        travel=calibration.travel,
        runs=calibration.runs,
        before_rms=calibration.before_rms,
        after_rms=calibration.after_rms,
        sensor=StoredSensorModel(
            **(asdict(calibration.model) | {"lag": calibration.model.lag.value})
        ),
        figures=tuple(
            StoredFigure(
                name=figure.name,
                value=figure.value,
                half_width=figure.half_width if np.isfinite(figure.half_width) else None,
                unit=figure.unit,
            )
            for figure in calibration.figures
        ),
        sources=sources,
        notes=tuple(note[:400] for note in calibration.notes),
        iso_reading_before=_to_iso_figures(calibration.reading_before),
        iso_reading_after=_to_iso_figures(calibration.reading_after),
        iso_reached=_to_iso_figures(calibration.reached),
    )


def make_source_record(record: Record, name: str) -> SourceRecord:
    """Return a record as a source of a calibration, with a digest of its content."""
    parts = [np.ascontiguousarray(record.time_s).tobytes()]
    for channel in record.columns:
        parts += [str(channel).encode(), np.ascontiguousarray(record.signal(*channel)).tobytes()]
    return SourceRecord(name=name[:200] or "record", digest=_digest(*parts))


def _digest(*parts: bytes) -> str:
    digest = hashlib.blake2b(digest_size=_DIGEST_BYTES)
    for part in parts:
        digest.update(part)
    return digest.hexdigest()


def _to_iso_figures(figures: PositioningFigures | None) -> IsoFigures | None:
    return IsoFigures(**figures._asdict()) if figures is not None else None
