"""Description of a machine: its axes, their coupling and its declared sensors.

Units are SI throughout (m, rad, kg, N, V, s). The numbers come from a robot file
(:mod:`rotemina.sim.robot_files`); the equations that use them are in :mod:`rotemina.sim.plant`.
"""

from collections.abc import Mapping
from dataclasses import field
from math import pi
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import serve_former_names
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

# Rounding may make a voltage exceed its limit by this ratio.
VOLTAGE_SLACK_RATIO = 1e-6


class AxisInertia(NamedTuple):
    """Mass, damping and stiffness of one axis (SI, linear or angular)."""

    mass: float
    damping: float
    stiffness: float


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class AxisSensor:
    """Declared resolution and white noise of an axis' own sensor, m or rad."""

    kind: str
    resolution: NotNegative = 0.0
    noise_rms: NotNegative = 0.0

    @property
    def noise_floor(self) -> float:
        """Noise floor ``sqrt(noise_rms² + resolution²/12)``, m or rad."""
        return float((self.noise_rms**2 + self.resolution**2 / 12.0) ** 0.5)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class CascadeController:
    """Sampled position loop around a speed loop.

    ``u_k = clip(kv (kp (cmd_k - q_k) - v_k) + add_k, ±limit)``, held until the next sample.

    Attributes: ``kp`` 1/s, ``kv`` V s/m or V s/rad, ``limit`` V. ``velocity``: how v is obtained,
    from the ``"backward"`` difference of the position or the true ``"state"``. ``delay_s``: delay
    of u.
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
    sensor: AxisSensor | None = None

    #: Default of ``following_bound``, as a share of the range.
    _following_bound_ratio: ClassVar[float] = 0.05

    @property
    def span(self) -> float:
        """Length of the range, m or rad."""
        return self.range[1] - self.range[0]

    @property
    def following_limit(self) -> float:
        """Distance of the reading from the command at which motion locks, m or rad."""
        return self.following_bound or self._following_bound_ratio * self.span

    @property
    def inertia(self) -> AxisInertia | None:
        """Mass, damping and stiffness (0 for a free axis), or None for a static axis.

        From a natural frequency f and damping ratio ζ, with the mass taken as 1:
        ``stiffness = (2πf)²``, ``damping = 2ζ(2πf)``.
        """
        if self.static:
            return None
        if self.natural_frequency_hz is not None and self.damping_ratio is not None:
            omega = 2.0 * pi * self.natural_frequency_hz
            return AxisInertia(1.0, 2.0 * self.damping_ratio * omega, omega**2)
        if self.mass is None or self.damping is None:
            raise ValueError("an axis with dynamics needs mass and damping")
        return AxisInertia(self.mass, self.damping, self.stiffness or 0.0)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class StepperAxis(_Axis):
    """Stepper with ball screw: its input is the commanded table position (m or rad)."""

    #: A stepper follows its command, without a voltage or a controller.
    gain: ClassVar[float] = 1.0
    voltage_range: ClassVar[None] = None
    controller: ClassVar[None] = None

    kind: Literal["stepper"]
    steps_per_rev: Count | None = None
    microsteps_per_step: Count | None = None
    pitch: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PiezoAxis(_Axis):
    """Piezo driven open loop with ``u = cmd / gain``; ``gain`` in m/V or rad/V."""

    # Hysteresis, creep and a load shift a piezo further from its command than other axes.
    _following_bound_ratio: ClassVar[float] = 0.35

    kind: Literal["piezo"]
    gain: Number
    voltage_range: Range | None = None
    controller: CascadeController | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class ForceAxis(_Axis):
    """Force on a mass: ``M q̈ + D q̇ + C q = gain·u - force_offset``; ``gain`` in N/V."""

    kind: Literal["force"]
    gain: Number
    force_offset: Number = 0.0
    voltage_range: Range | None = None
    controller: CascadeController | None = None


Axis = StepperAxis | PiezoAxis | ForceAxis


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class AxisCoupling:
    """Off-diagonal, symmetric entry of M, D or C between two axes (SI)."""

    matrix: Literal["M", "D", "C"]
    axes: tuple[str, str]
    value: Number


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisEffect:
    """Effect on an axis, as specified in a robot file (:mod:`rotemina.sim.effects`).

    ``parameters`` are SI; omitted ones have their presets. ``formulation`` None is the default one.
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
        """Return the rms on an axis whose unit is ``rad``, or else ``m``; None if undeclared."""
        return self.angular if unit == "rad" else self.linear


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class ReferenceSensor:
    """Declared noise of the independent reference (laser, microscope)."""

    noise_rms: ReferenceNoise = field(default_factory=ReferenceNoise)


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class RobotTool:
    """Pin or pipette: its approach angle to the dish, rad."""

    approach_angle: Number | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class RobotMicroscope:
    """Microscope and its camera; lengths in m."""

    optical_axis: tuple[Number, Number, Number] | None = None
    pixel_size: Positive | None = None
    magnification: Positive | None = None
    numerical_aperture: Positive | None = None
    depth_of_field: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class KeepOut:
    """Region that the tip must not enter, m; see :mod:`rotemina.sim.kinematics.keep_out`."""

    floor: Number | None = None
    radius: Positive | None = None
    objective: Number | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """Machine: named axes in the order of ``q``, their coupling and their surroundings.

    ``stages`` are the groups of axes that the operator sees. ``pin_length`` and
    ``piezo_lever_arm`` are in m. ``plate`` holds the pin; every machine has one, by default the
    shipped one. ``effects`` make the machine imperfect, in the order in which a signal passes them.
    """

    name: str
    axes: Mapping[str, Axis]
    stages: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    couplings: tuple[AxisCoupling, ...] = ()
    pin_length: float | None = None
    piezo_lever_arm: float | None = None
    reference: ReferenceSensor = field(default_factory=ReferenceSensor)
    tool: RobotTool = field(default_factory=RobotTool)
    microscope: RobotMicroscope = field(default_factory=RobotMicroscope)
    keep_out: KeepOut = field(default_factory=KeepOut)
    plate: Plate = field(default_factory=Plate)
    effects: tuple[AxisEffect, ...] = ()

    def unit(self, axis: str) -> str | None:
        """Return ``"m"`` or ``"rad"``, or None if the robot file leaves the unit to the record."""
        return self.axes[axis].unit


class InertiaMatrices(NamedTuple):
    """Matrices ``M``, ``D``, ``C`` (m, m) of the m axes with dynamics, in the order of ``axes``."""

    axes: tuple[str, ...]
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray


def assemble_inertia_matrices(robot: Robot) -> InertiaMatrices:
    """Assemble M, D, C (SI) over the axes that are not static, in the robot's order."""
    inertias = {name: axis.inertia for name, axis in robot.axes.items()}
    dynamic_axes = tuple(name for name, inertia in inertias.items() if inertia is not None)
    diagonals = np.array([inertias[name] for name in dynamic_axes], dtype=np.float64).reshape(-1, 3)
    matrices = {letter: np.diag(diagonals[:, k]) for k, letter in enumerate("MDC")}
    for coupling in robot.couplings:
        first, second = (dynamic_axes.index(name) for name in coupling.axes)
        matrices[coupling.matrix][first, second] = coupling.value
        matrices[coupling.matrix][second, first] = coupling.value
    return InertiaMatrices(dynamic_axes, matrices["M"], matrices["D"], matrices["C"])


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Coupling="AxisCoupling",
        Inertia="AxisInertia",
        Microscope="RobotMicroscope",
        Reference="ReferenceSensor",
        Sensor="AxisSensor",
        Tool="RobotTool",
        VOLTAGE_SLACK="VOLTAGE_SLACK_RATIO",
    )
