"""Scales of each mode: distance, speed and force at full deflection, with presets and file.

Full deflection means a distance (linear position), a speed (linear rate), or a force on a virtual
mass (impedance). Each coordinate has its own scale. The presets depend on the coordinate's range.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from enum import StrEnum
from math import ceil, floor, log10, sqrt
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation.force_feedback import ContactFeedback
from rotemina.app.motion.teleoperation.frames import FrameCoordinate
from rotemina.app.motion.teleoperation.impedance import ImpedanceLaw
from rotemina.app.motion.teleoperation.linear_laws import LinearPositionLaw, LinearRateLaw
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.app.settings import (
    FORBID_EXTRA_KEYS,
    NonEmptyText,
    TomlFormat,
)
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.units import format_exact

# A linear axis with at least this range counts as a table, others as piezos.
_MIN_TABLE_RANGE_M = 5e-3
# Presets of a table for full deflection.
_TABLE_TRAVEL_M, _TABLE_SPEED_M_S = 5e-4, 1e-3
# Presets of a piezo for full deflection: this fraction of its range, travelled in this time.
_PIEZO_RANGE_RATIO = 0.25
_PIEZO_TRAVEL_S = 4.0
# Preset for a virtual mass without a spring.
_DEFAULT_TIME_CONSTANT_S = 0.2
# A preset uses at most this fraction of the maximum speed of the coordinate.
_MAX_PRESET_SPEED_RATIO = 0.5
# A reference uses this fraction of the maximum speed and acceleration, so that the axes can catch
# up with it.
_USABLE_LIMIT_RATIO = 0.8


class LawKind(StrEnum):
    """Scaling laws, in the order in which a button cycles through them."""

    POSITION = "position"
    RATE = "rate"
    IMPEDANCE = "impedance"

    @property
    def next(self) -> "LawKind":
        """The law that follows this one in the cycle."""
        kinds = list(LawKind)
        return kinds[(kinds.index(self) + 1) % len(kinds)]


PositiveNumber = Annotated[float, Field(strict=True, gt=0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class CoordinateScale:
    """Motion of one coordinate for full deflection, in SI units.

    Attributes
    ----------
    way : float
        Distance of the linear position law, m or rad.
    speed : float
        Speed of the linear rate law, and final speed of a virtual mass without a spring, per s.
    time_constant_s : float
        Time constant with which the virtual mass reaches this speed.
    spring_hz, damping_ratio : float
        Natural frequency and damping ratio of a virtual mass on a spring. Full deflection moves the
        mass by ``way`` from its rest position. With a frequency of 0 there is no spring.
    contact_gain : float
        Gain of the contact force, as a fraction of the highest passive gain; 0 for no force.
    """

    way: PositiveNumber
    speed: PositiveNumber
    time_constant_s: Annotated[float, Field(strict=True, ge=0.02, le=5.0)] = (
        _DEFAULT_TIME_CONSTANT_S
    )
    spring_hz: Annotated[float, Field(strict=True, ge=0, le=5.0)] = 0.0
    damping_ratio: Annotated[float, Field(strict=True, ge=0.1, le=10.0)] = 1.0
    contact_gain: Annotated[float, Field(strict=True, ge=0, le=1.0)] = 0.0

    @classmethod
    def make_preset(cls, coordinate: FrameCoordinate) -> "CoordinateScale":
        """Return the preset for a coordinate, which depends on its range."""
        bounds = coordinate.bounds
        span = bounds.high - bounds.low
        if coordinate.unit == "m" and span >= _MIN_TABLE_RANGE_M:
            distance, speed = _TABLE_TRAVEL_M, _TABLE_SPEED_M_S
        else:
            distance = _PIEZO_RANGE_RATIO * span
            speed = distance / _PIEZO_TRAVEL_S
        return cls(way=distance, speed=min(speed, _MAX_PRESET_SPEED_RATIO * bounds.max_speed))

    def make_law(self, kind: LawKind, coordinate: FrameCoordinate, noise: float) -> ScalingLaw:
        """Return a law with this scale.

        ``noise`` is the noise of the contact signal while the tip is free, m or rad.

        Raises
        ------
        ScalingError
            If the coordinate is too slow for the impedance. The message says what to change.
        """
        bounds = replace(
            coordinate.bounds,
            max_speed=_USABLE_LIMIT_RATIO * coordinate.bounds.max_speed,
            max_acceleration=_USABLE_LIMIT_RATIO * coordinate.bounds.max_acceleration,
        )
        if kind is LawKind.POSITION:
            return LinearPositionLaw(bounds, self.way)
        if kind is LawKind.RATE:
            return LinearRateLaw(bounds, self.speed)
        impedance = self.impedance
        contact = None
        if self.contact_gain:
            feedback_without_gain = ContactFeedback(0.0, noise, 0.0)
            gain = self.contact_gain * feedback_without_gain.compute_max_gain(impedance)
            contact = ContactFeedback(gain, noise, impedance.force)
        try:
            return ImpedanceLaw(bounds, impedance, contact)
        except ScalingError as error:
            # Half of the acceleration is reserved for the contact force.
            max_acceleration = bounds.max_acceleration / (2.0 if contact else 1.0)
            excess = impedance.force * impedance.max_acceleration_per_force / max_acceleration
            raise ScalingError(self._describe_excess(coordinate, excess)) from error

    def _describe_excess(self, coordinate: FrameCoordinate, excess: float) -> str:
        """Return a message about an acceleration that is ``excess`` times too high."""
        name, unit = coordinate.name, coordinate.unit
        if self.spring_hz:
            return message(
                "engine",
                "{name}: a travel of {way} on a spring of {spring_hz} Hz is more than the axes "
                "can accelerate; use at most {most}, or at most {other} Hz",
            ).fill(
                name=name,
                way=format_exact(self.way, unit),
                spring_hz=format_rounded(self.spring_hz),
                most=format_exact(_round_bound(self.way / excess), unit),
                other=format_rounded(_round_bound(self.spring_hz / sqrt(excess)), 6),
            )
        return message(
            "engine",
            "{name}: {speed} within a time constant of {time_constant_s} s is more than the axes "
            "can accelerate; use at most {most}, or at least {other} s",
        ).fill(
            name=name,
            speed=format_exact(self.speed, f"{unit}/s"),
            time_constant_s=format_rounded(self.time_constant_s),
            most=format_exact(_round_bound(self.speed / excess), f"{unit}/s"),
            other=format_rounded(_round_bound(self.time_constant_s * excess, up=True), 6),
        )

    @property
    def impedance(self) -> VirtualImpedance:
        """The virtual mechanism, scaled to a force of 1 at full deflection."""
        if self.spring_hz:
            return VirtualImpedance.make_sprung(self.way, self.spring_hz, self.damping_ratio)
        return VirtualImpedance.make_gliding(self.speed, self.time_constant_s)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_EXTRA_KEYS)
class ModeScales:
    """Scales of all modes, by mode and coordinate. Missing entries stand for presets."""

    modes: Mapping[NonEmptyText, Mapping[NonEmptyText, CoordinateScale]] = field(
        default_factory=dict
    )

    def find_scale(self, mode: str, coordinate: FrameCoordinate) -> CoordinateScale:
        """Return the scale of a coordinate."""
        stored = self.modes.get(mode, {}).get(coordinate.name)
        return CoordinateScale.make_preset(coordinate) if stored is None else stored

    def with_scale(self, mode: str, coordinate: str, scale: CoordinateScale) -> "ModeScales":
        """Return a copy with one scale changed."""
        mode_scales = {**self.modes.get(mode, {}), coordinate: scale}
        return ModeScales(
            modes=MappingProxyType({**self.modes, mode: MappingProxyType(mode_scales)})
        )

    @classmethod
    def load(cls, path: Path) -> "ModeScales":
        """Read a file, or return the presets if the file does not exist.

        Raises
        ------
        ScalingError
            If the file is invalid. The message names file, key, value and bound.
        """
        return _FILE_FORMAT.load(path) if path.exists() else cls()

    def save(self, path: Path) -> None:
        """Write the file atomically.

        Raises
        ------
        FileWriteError
            If the file cannot be written.
        """
        _FILE_FORMAT.save(path, self)


def _round_bound(bound: float, *, up: bool = False) -> float:
    """Return a bound rounded to three significant digits, downwards unless ``up``."""
    last_digit_value = 10.0 ** (floor(log10(bound)) - 2)
    return (ceil if up else floor)(bound / last_digit_value) * last_digit_value


_FILE_FORMAT = TomlFormat(ModeScales, {"modes": CoordinateScale}, ScalingError)
