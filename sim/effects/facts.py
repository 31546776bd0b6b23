"""Properties of an axis that its effects may use."""

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING, Self

from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.robot import (
    Axis,
    ForceAxis,
    StepperAxis,
)

# Smallest force that bends an axis noticeably, relative to stiffness times range.
_NOTICEABLE_FORCE_RATIO = 1e-4
# Assumed number of screw pitches in the range if the robot file declares no pitch.
_PITCHES_PER_RANGE = 50
_STEPS_PER_PITCH = 200
_DEFAULT_PACE_HZ = 100.0
# Assumed noise floor, relative to the range, if no sensor is declared.
_DEFAULT_NOISE_RATIO = 1e-5


@dataclass(frozen=True, slots=True)
class AxisProperties:
    """Properties of one axis, SI, with defaults for those that a robot file omits.

    Attributes
    ----------
    kind : str
        ``piezo``, ``stepper`` or ``force``.
    unit : str
        Unit of positions: ``m`` or ``rad``.
    low, high, span : float
        Ends and length of the range.
    input_low, input_high, input_span : float
        Ends and length of the input range: V, or the commanded position of a stepper.
    gain : float
        Position per volt of a piezo, N/V of a force axis, 1 of a stepper.
    mass, damping, stiffness : float
        0 if the axis has none.
    free_damping : float
        Damping of an axis without stiffness, which is viscous friction; 0 for other axes.
    frequency_hz, damping_ratio : float
        Natural frequency and damping ratio of the axis alone; 0 without stiffness.
    pace_hz : float
        The natural frequency, or 100 Hz if there is none.
    force : float
        A force (N, or N m) that moves or bends the axis noticeably.
    pitch, full_step : float
        Pitch and full step of the screw.
    has_pitch : bool
        Whether the robot file declares the pitch.
    noise : float
        Declared noise floor of the sensor; by default a hundred-thousandth of the range.
    """

    kind: str
    unit: str
    low: float
    high: float
    span: float
    input_low: float
    input_high: float
    input_span: float
    gain: float
    mass: float
    damping: float
    stiffness: float
    free_damping: float
    frequency_hz: float
    damping_ratio: float
    pace_hz: float
    force: float
    pitch: float
    full_step: float
    has_pitch: bool
    noise: float

    @property
    def is_static(self) -> bool:
        """Whether the axis follows its input immediately."""
        return self.mass == 0.0

    @classmethod
    def of(cls, axis: Axis) -> Self:
        """Return the properties of an axis."""
        low, high = axis.range
        input_range = _find_input_range(axis)
        inertia = axis.inertia
        mass, damping, stiffness = inertia if inertia is not None else (0.0, 0.0, 0.0)
        omega = sqrt(stiffness / mass) if mass > 0.0 else 0.0
        pitch = axis.pitch if isinstance(axis, StepperAxis) else None
        steps_per_rev = axis.steps_per_rev if isinstance(axis, StepperAxis) else None
        has_pitch = pitch is not None
        pitch = pitch or (high - low) / _PITCHES_PER_RANGE
        return cls(
            kind=axis.kind,
            unit=axis.unit or "m",
            low=low,
            high=high,
            span=high - low,
            input_low=input_range[0],
            input_high=input_range[1],
            input_span=input_range[1] - input_range[0],
            gain=axis.gain,
            mass=mass,
            damping=damping,
            stiffness=stiffness,
            free_damping=0.0 if stiffness > 0.0 else damping,
            frequency_hz=omega / (2.0 * pi),
            damping_ratio=damping / (2.0 * mass * omega) if omega > 0.0 else 0.0,
            pace_hz=omega / (2.0 * pi) or _DEFAULT_PACE_HZ,
            force=_compute_noticeable_force(axis, stiffness, input_range),
            pitch=pitch,
            full_step=pitch / (steps_per_rev or _STEPS_PER_PITCH),
            has_pitch=has_pitch,
            noise=(axis.sensor.noise_floor if axis.sensor else 0.0)
            or _DEFAULT_NOISE_RATIO * (high - low),
        )


def _find_input_range(axis: Axis) -> tuple[float, float]:
    if not isinstance(axis, ForceAxis):
        ordered_bounds = sorted(bound / axis.gain for bound in axis.range)
        low, high = axis.voltage_range or (ordered_bounds[0], ordered_bounds[1])
        return low, high
    if axis.voltage_range is not None:
        return axis.voltage_range
    limit = axis.controller.limit if axis.controller is not None else 10.0
    return -limit, limit


def _compute_noticeable_force(
    axis: Axis, stiffness: float, input_range: tuple[float, float]
) -> float:
    if isinstance(axis, ForceAxis):
        return abs(axis.gain) * (input_range[1] - input_range[0])
    return _NOTICEABLE_FORCE_RATIO * stiffness * axis.span


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Facts="AxisProperties",
    )
