"""Scales of each mode (distance, speed, force at full deflection): presets and file.

A full deflection means a way (linear position), a speed (linear rate), or a force on a virtual mass
(impedance); of each coordinate its own. The presets follow from a coordinate's range.
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

from rotemina.app.motion.teleoperation.force_feedback import Contact
from rotemina.app.motion.teleoperation.frames import Coordinate
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.linear_laws import LinearPosition, LinearRate
from rotemina.app.motion.teleoperation.reference import ScalingError
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.app.toml_file import STRICT, Format, Text
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded

_LONG = 5e-3  # m: what has a longer range is a table
_TABLE_WAY, _TABLE_SPEED = 5e-4, 1e-3  # m, m/s at full deflection
_SHARE_OF_RANGE = 0.25  # of a piezo, at full deflection
_CROSSING_S = 4.0  # for that share, at full deflection
_TIME_CONSTANT_S = 0.2  # of a virtual mass that glides
_MOST_SHARE = 0.5  # of the coordinate's greatest speed that a preset uses
# Of greatest speed and acceleration that a reference uses: the rest lets the axes catch up with it.
_MARGIN = 0.8


class LawKind(StrEnum):
    """The scaling laws, in the order in which a button goes through them."""

    POSITION = "position"
    RATE = "rate"
    IMPEDANCE = "impedance"

    @property
    def next(self) -> "LawKind":
        """The law after this one; the first after the last."""
        kinds = list(LawKind)
        return kinds[(kinds.index(self) + 1) % len(kinds)]


Positive = Annotated[float, Field(strict=True, gt=0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Scale:
    """What full deflection means for one coordinate; SI.

    Attributes
    ----------
    way : float
        Linear position, m or rad.
    speed : float
        Linear rate, and where a gliding virtual mass ends, per s.
    time_constant_s : float
        In which the virtual mass gets there.
    spring_hz, damping_ratio : float
        Of a virtual mass on a spring, which full deflection leads ``way`` from its rest; a
        frequency of 0: no spring, it glides.
    contact_gain : float
        Share of the greatest passive gain by which a contact is felt; 0: not at all.
    """

    way: Positive
    speed: Positive
    time_constant_s: Annotated[float, Field(strict=True, ge=0.02, le=5.0)] = _TIME_CONSTANT_S
    spring_hz: Annotated[float, Field(strict=True, ge=0, le=5.0)] = 0.0
    damping_ratio: Annotated[float, Field(strict=True, ge=0.1, le=10.0)] = 1.0
    contact_gain: Annotated[float, Field(strict=True, ge=0, le=1.0)] = 0.0

    @classmethod
    def preset(cls, coordinate: Coordinate) -> "Scale":
        """Return what suits a coordinate's range."""
        bounds = coordinate.bounds
        span = bounds.high - bounds.low
        if coordinate.unit == "m" and span >= _LONG:
            way, speed = _TABLE_WAY, _TABLE_SPEED
        else:
            way = _SHARE_OF_RANGE * span
            speed = way / _CROSSING_S
        return cls(way=way, speed=min(speed, _MOST_SHARE * bounds.max_speed))

    def law(self, kind: LawKind, coordinate: Coordinate, noise: float) -> ScalingLaw:
        """Return a law with this scale.

        ``noise`` is what the reading of a contact strays by without one, m or rad.

        Raises
        ------
        ScalingError
            If the coordinate cannot do what an impedance asks for, with what to change.
        """
        bounds = replace(
            coordinate.bounds,
            max_speed=_MARGIN * coordinate.bounds.max_speed,
            max_acceleration=_MARGIN * coordinate.bounds.max_acceleration,
        )
        if kind is LawKind.POSITION:
            return LinearPosition(bounds, self.way)
        if kind is LawKind.RATE:
            return LinearRate(bounds, self.speed)
        impedance = self.impedance
        contact = None
        if self.contact_gain:
            free = Contact(0.0, noise, 0.0)
            gain = self.contact_gain * free.greatest_gain(impedance)
            contact = Contact(gain, noise, impedance.force)
        try:
            return Impedance(bounds, impedance, contact)
        except ScalingError as error:
            most = bounds.max_acceleration / (2.0 if contact else 1.0)
            excess = impedance.force * impedance.acceleration_per_force / most
            raise ScalingError(self._too_brisk(coordinate, excess)) from error

    def _too_brisk(self, coordinate: Coordinate, excess: float) -> str:
        """Return what to change of an impedance that accelerates so many times too fast."""
        name, unit = coordinate.name, coordinate.unit
        if self.spring_hz:
            return message(
                "engine",
                "{name}: a travel of {way} on a spring of {spring_hz} Hz is more than the axes "
                "can accelerate; use at most {most}, or at most {other} Hz",
            ).fill(
                name=name,
                way=exact(self.way, unit),
                spring_hz=rounded(self.spring_hz),
                most=exact(_rounded(self.way / excess), unit),
                other=rounded(_rounded(self.spring_hz / sqrt(excess)), 6),
            )
        return message(
            "engine",
            "{name}: {speed} within a time constant of {time_constant_s} s is more than the axes "
            "can accelerate; use at most {most}, or at least {other} s",
        ).fill(
            name=name,
            speed=exact(self.speed, f"{unit}/s"),
            time_constant_s=rounded(self.time_constant_s),
            most=exact(_rounded(self.speed / excess), f"{unit}/s"),
            other=rounded(_rounded(self.time_constant_s * excess, up=True), 6),
        )

    @property
    def impedance(self) -> VirtualImpedance:
        """The virtual mechanism, of a force of 1 at full deflection."""
        if self.spring_hz:
            return VirtualImpedance.sprung(self.way, self.spring_hz, self.damping_ratio)
        return VirtualImpedance.gliding(self.speed, self.time_constant_s)


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Scales:
    """The scales of all modes, by mode and coordinate; what is not in it has its preset."""

    modes: Mapping[Text, Mapping[Text, Scale]] = field(default_factory=dict)

    def of(self, mode: str, coordinate: Coordinate) -> Scale:
        """Return the scale of a coordinate."""
        kept = self.modes.get(mode, {}).get(coordinate.name)
        return Scale.preset(coordinate) if kept is None else kept

    def with_scale(self, mode: str, coordinate: str, scale: Scale) -> "Scales":
        """Return them with one scale changed."""
        changed = {**self.modes.get(mode, {}), coordinate: scale}
        return Scales(modes=MappingProxyType({**self.modes, mode: MappingProxyType(changed)}))

    @classmethod
    def load(cls, path: Path) -> "Scales":
        """Read a file; presets, where there is none.

        Raises
        ------
        ScalingError
            With file, key, value and bound.
        """
        return _FORMAT.load(path) if path.exists() else cls()

    def save(self, path: Path) -> None:
        """Write the file, completely or not at all.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        _FORMAT.save(path, self)


def _rounded(bound: float, *, up: bool = False) -> float:
    """Return a bound in three digits, on the side that is allowed."""
    digit = 10.0 ** (floor(log10(bound)) - 2)
    return (ceil if up else floor)(bound / digit) * digit


_FORMAT = Format(Scales, {"modes": Scale}, ScalingError)
