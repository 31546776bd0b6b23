"""The TOML file of a sensor's calibration: strict, dated, with its origin."""

import hashlib
from dataclasses import asdict
from datetime import datetime
from typing import Annotated, Literal

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.motion.sensor_corrections import AppliedCalibration
from rotemina.app.toml_file import STRICT, Format, Text
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.iso230 import Positioning
from rotemina.sim.calibration.sensor import BENDS, SHARES, SensorModel
from rotemina.sim.calibration.sensor_calibration import Calibration
from rotemina.sim.calibration.sensor_lag import MOST_S, Lag
from rotemina.sim.records.record import Record

VERSION = 1
_PER_BYTES = 8

Finite = Annotated[float, Field(strict=False, allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Count = Annotated[int, Field(strict=True, ge=1)]
Digest = Annotated[str, Field(strict=True, pattern="^[0-9a-f]{16}$")]
Line = Annotated[str, Field(strict=True, max_length=400)]


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Source:
    """A source record of a calibration, with the digest of its content."""

    name: Text
    digest: Digest


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Sensor:
    """The sensor's model, SI, as :class:`rotemina.sim.calibration.sensor.SensorModel`."""

    low: Finite
    high: Finite
    offset: Finite
    gain_error: Annotated[float, Field(gt=-0.9, lt=10.0)]
    bend: Annotated[tuple[Finite, ...], Field(max_length=BENDS)] = ()
    radii: Annotated[tuple[Positive, ...], Field(max_length=len(SHARES))] = ()
    weights: Annotated[tuple[Finite, ...], Field(max_length=len(SHARES))] = ()
    lag: Literal["none", "first_order", "delay"] = "none"
    lag_s: Annotated[float, Field(ge=0.0, le=MOST_S)] = 0.0
    period: NotNegative = 0.0
    harmonics: Annotated[tuple[Finite, ...], Field(max_length=4)] = ()

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise ValueError(f"low must be less than high, {self.high!r}")
        if len(self.radii) != len(self.weights):
            raise ValueError(f"{len(self.radii)} radii need as many weights")
        if len(self.harmonics) != (4 if self.period else 0):
            raise ValueError("a period needs 4 harmonics, and they a period")

    @property
    def model(self) -> SensorModel:
        """The model that computes."""
        return SensorModel(**(asdict(self) | {"lag": Lag(self.lag)}))


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class KeptFigure:
    """A figure with the half width of its 95 % interval, where it has one."""

    name: Text
    value: Finite
    half_width: NotNegative | None = None
    unit: Text


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Iso:
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
    def figures(self) -> Positioning:
        """As they were computed."""
        return Positioning(*(getattr(self, name) for name in Positioning._fields))


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class CalibrationFile:
    """All that is kept of one axis' calibration."""

    version: Annotated[int, Field(strict=True, ge=VERSION, le=VERSION)] = VERSION
    robot: Text
    axis: Text
    unit: Literal["m", "rad"]
    date: Text
    travel: tuple[Finite, Finite]
    runs: Count
    before_rms: NotNegative
    after_rms: NotNegative
    sensor: Sensor
    figures: tuple[KeptFigure, ...]
    sources: Annotated[tuple[Source, ...], Field(min_length=1)]
    notes: tuple[Line, ...] = ()
    iso_reading_before: Iso | None = None
    iso_reading_after: Iso | None = None
    iso_reached: Iso | None = None

    def __post_init__(self) -> None:
        if not self.travel[0] < self.travel[1]:
            raise ValueError(f"travel must rise, {self.travel!r}")
        try:
            datetime.fromisoformat(self.date)
        except ValueError:
            raise ValueError(f"date must be ISO 8601, not {self.date!r}") from None

    @property
    def name(self) -> str:
        """Date and digest: what records and screens call it."""
        return f"{self.date} {_digest(FORMAT.text(self).encode())[:8]}"

    @property
    def applied(self) -> AppliedCalibration:
        """As a session applies it."""
        return AppliedCalibration(self.name, self.sensor.model, self.travel)


FORMAT = Format(
    CalibrationFile,
    {
        "sensor": Sensor,
        "figures": KeptFigure,
        "sources": Source,
        "iso_reading_before": Iso,
        "iso_reading_after": Iso,
        "iso_reached": Iso,
    },
    CalibrationError,
)


def kept(
    calibration: Calibration, robot: str, sources: tuple[Source, ...], date: datetime
) -> CalibrationFile:
    """Return the stored form of a calibration.

    Raises
    ------
    CalibrationError
        If it is none that may be used.
    """
    if calibration.refusal is not None:
        raise CalibrationError(calibration.refusal)
    return CalibrationFile(
        robot=robot,
        axis=calibration.axis,
        unit="rad" if calibration.unit == "rad" else "m",
        date=date.isoformat(timespec="seconds"),
        travel=calibration.travel,
        runs=calibration.runs,
        before_rms=calibration.before_rms,
        after_rms=calibration.after_rms,
        sensor=Sensor(**(asdict(calibration.model) | {"lag": calibration.model.lag.value})),
        figures=tuple(
            KeptFigure(
                name=each.name,
                value=each.value,
                half_width=each.half_width if np.isfinite(each.half_width) else None,
                unit=each.unit,
            )
            for each in calibration.figures
        ),
        sources=sources,
        notes=tuple(note[:400] for note in calibration.notes),
        iso_reading_before=_iso(calibration.reading_before),
        iso_reading_after=_iso(calibration.reading_after),
        iso_reached=_iso(calibration.reached),
    )


def source_of(record: Record, name: str) -> Source:
    """Return a record's name in a calibration, derived from its content."""
    parts = [np.ascontiguousarray(record.time_s).tobytes()]
    for channel in record.columns:
        parts += [str(channel).encode(), np.ascontiguousarray(record.signal(*channel)).tobytes()]
    return Source(name=name[:200] or "record", digest=_digest(*parts))


def _digest(*parts: bytes) -> str:
    digest = hashlib.blake2b(digest_size=_PER_BYTES)
    for part in parts:
        digest.update(part)
    return digest.hexdigest()


def _iso(figures: Positioning | None) -> Iso | None:
    return Iso(**figures._asdict()) if figures is not None else None
