"""The description of a machine: its axes, their coupling and what its sensors declare.

Units are SI throughout (m, rad, kg, N, V, s). The numbers come from a robot file
(:mod:`rotemina.sim.robot.file`); the equations that use them are in :mod:`rotemina.sim.plant`.
"""

from collections.abc import Mapping
from dataclasses import field
from math import pi
from typing import Annotated, ClassVar, Literal, NamedTuple

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.sim.robot.numbers import (
    FORBID_UNKNOWN,
    Count,
    NotNegative,
    Number,
    Positive,
    Range,
    Switch,
)
from rotemina.sim.robot.plate import Plate

VOLTAGE_SLACK = 1e-6  # relative slack of voltage limits


class Inertia(NamedTuple):
    """The second-order figures of one axis: mass, damping, stiffness (SI, linear or angular)."""

    mass: float
    damping: float
    stiffness: float


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Sensor:
    """What an axis' own sensor declares: resolution and white noise, m or rad."""

    kind: str
    resolution: NotNegative = 0.0
    noise_rms: NotNegative = 0.0

    @property
    def noise_floor(self) -> float:
        """Declared noise floor ``sqrt(noise_rms² + resolution²/12)``, m or rad."""
        return float((self.noise_rms**2 + self.resolution**2 / 12.0) ** 0.5)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class CascadeController:
    """Sampled position loop around a speed loop.

    ``u_k = clip(kv (kp (cmd_k - q_k) - v_k) + add_k, ±limit)``, held until the next sample.

    Attributes: ``kp`` 1/s, ``kv`` V s/m or V s/rad, ``limit`` V, ``velocity`` how v is obtained
    (``"backward"`` difference of the position, or the true ``"state"``), ``delay_s`` of u.
    """

    kind: Literal["cascade"]
    kp: Positive
    kv: Positive
    limit: Positive
    velocity: Literal["backward", "state"] = "state"
    delay_s: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1.0)] = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class _Axis:
    range: Range
    unit: Literal["m", "rad"] | None = None
    mass: Positive | None = None
    damping: NotNegative | None = None
    stiffness: Positive | None = None
    natural_frequency_hz: Positive | None = None
    damping_ratio: NotNegative | None = None
    static: Switch = False
    offset: Number = 0.0
    max_speed: Positive | None = None
    max_acceleration: Positive | None = None
    repeatability: NotNegative = 0.0
    following_bound: Positive | None = None
    sensor: Sensor | None = None

    #: Share of the range that ``following_bound`` is where a robot file does not give it.
    _following_share: ClassVar[float] = 0.05

    @property
    def span(self) -> float:
        """Length of the range, m or rad."""
        return self.range[1] - self.range[0]

    @property
    def following(self) -> float:
        """How far the reading may be from the command before motion locks, m or rad."""
        return self.following_bound or self._following_share * self.span

    @property
    def inertia(self) -> Inertia | None:
        """Mass, damping and stiffness (0 if free), or None for a static axis.

        From a natural frequency f and damping ratio ζ, with the mass taken as 1:
        ``stiffness = (2πf)²``, ``damping = 2ζ(2πf)``.
        """
        if self.static:
            return None
        if self.natural_frequency_hz is not None and self.damping_ratio is not None:
            rate = 2.0 * pi * self.natural_frequency_hz
            return Inertia(1.0, 2.0 * self.damping_ratio * rate, rate**2)
        if self.mass is None or self.damping is None:
            raise ValueError("an axis with dynamics needs mass and damping")
        return Inertia(self.mass, self.damping, self.stiffness or 0.0)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class StepperAxis(_Axis):
    """A stepper with ball screw: its input is the commanded table position (m or rad)."""

    #: It goes where it is told, by no voltage and under no controller.
    gain: ClassVar[float] = 1.0
    voltage_range: ClassVar[None] = None
    controller: ClassVar[None] = None

    kind: Literal["stepper"]
    steps_per_rev: Count | None = None
    microsteps_per_step: Count | None = None
    pitch: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PiezoAxis(_Axis):
    """A piezo driven open loop with ``u = cmd / gain``; ``gain`` in m/V or rad/V."""

    _following_share: ClassVar[float] = 0.35  # hysteresis, creep and a load take their part

    kind: Literal["piezo"]
    gain: Number
    voltage_range: Range | None = None
    controller: CascadeController | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class ForceAxis(_Axis):
    """A force on a mass: ``M q̈ + D q̇ + C q = gain·u - force_offset``; ``gain`` in N/V."""

    kind: Literal["force"]
    gain: Number
    force_offset: Number = 0.0
    voltage_range: Range | None = None
    controller: CascadeController | None = None


Axis = StepperAxis | PiezoAxis | ForceAxis


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Coupling:
    """An off-diagonal, symmetric entry of M, D or C between two axes (SI)."""

    matrix: Literal["M", "D", "C"]
    axes: tuple[str, str]
    value: Number


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisEffect:
    """An effect that sits on an axis, as a robot file names it (:mod:`rotemina.sim.effects`).

    ``parameters`` are SI; those left out have their preset. ``formulation`` None is the usual one.
    """

    axis: str
    id: str
    formulation: str | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    from_axis: str | None = None
    enabled: bool = True


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class ReferenceNoise:
    """White noise of the independent reference, m and rad."""

    linear: NotNegative | None = None
    angular: NotNegative | None = None

    def of(self, unit: str | None) -> float | None:
        """Return the rms on an axis whose unit is ``rad``, or ``m``; None where undeclared."""
        return self.angular if unit == "rad" else self.linear


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Reference:
    """What the independent reference (laser, microscope) declares."""

    noise_rms: ReferenceNoise = field(default_factory=ReferenceNoise)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Tool:
    """The pin or pipette: its approach angle to the dish, rad."""

    approach_angle: Number | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Microscope:
    """The microscope and its camera; lengths in m."""

    optical_axis: tuple[Number, Number, Number] | None = None
    pixel_size: Positive | None = None
    magnification: Positive | None = None
    numerical_aperture: Positive | None = None
    depth_of_field: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class KeepOut:
    """Where the tip must not go, m: :class:`rotemina.sim.kinematics.keep_out.KeepOutZone`."""

    floor: Number | None = None
    radius: Positive | None = None
    objective: Number | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """A machine: named axes in the order of ``q``, their coupling and their surroundings.

    ``stages`` names groups of axes for the operator; ``pin_length`` and ``piezo_lever_arm`` in m;
    ``plate`` holds the pin (every machine has one, the shipped one unless the file says otherwise);
    ``effects`` are what makes it imperfect, in the order in which a signal meets them.
    """

    name: str
    axes: Mapping[str, Axis]
    stages: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    couplings: tuple[Coupling, ...] = ()
    pin_length: float | None = None
    piezo_lever_arm: float | None = None
    reference: Reference = field(default_factory=Reference)
    tool: Tool = field(default_factory=Tool)
    microscope: Microscope = field(default_factory=Microscope)
    keep_out: KeepOut = field(default_factory=KeepOut)
    plate: Plate = field(default_factory=Plate)
    effects: tuple[AxisEffect, ...] = ()

    def unit(self, axis: str) -> str | None:
        """Return ``"m"`` or ``"rad"``, or None where the robot file leaves it to the record."""
        return self.axes[axis].unit
