"""Facts about the axis of an effect that the effect may use."""

from dataclasses import dataclass
from math import pi, sqrt
from typing import Self

from rotemina.sim.robot.model import Axis, ForceAxis, StepperAxis

_FORCE_SHARE = 1e-4  # of stiffness times range: a force that bends an axis noticeably
_PITCHES = 50  # that a range is taken to hold where the robot file names no screw
_STEPS_PER_PITCH = 200
_PACE_HZ = 100.0
_NOISE_SHARE = 1e-5  # of the range, where no sensor is declared


@dataclass(frozen=True, slots=True)
class Facts:
    """Figures of one axis, SI, with substitutes for those that a robot file leaves out.

    Attributes
    ----------
    kind : str
        ``piezo``, ``stepper`` or ``force``.
    unit : str
        Of positions: ``m`` or ``rad``.
    low, high, span : float
        Ends and length of the range.
    input_low, input_high, input_span : float
        Of the input: V, or the commanded position of a stepper.
    gain : float
        Position per volt of a piezo, N/V of a force axis, 1 of a stepper.
    mass, damping, stiffness : float
        0 where there is none.
    free_damping : float
        Damping of an axis that nothing holds, which is viscous friction; 0 of others.
    frequency_hz, damping_ratio : float
        Of the axis alone; 0 where nothing holds it.
    pace_hz : float
        Its frequency; 100 Hz where it has none.
    force : float
        A force (N, or N m) that the axis notices.
    pitch, full_step : float
        Of the screw.
    has_pitch : bool
        Whether the robot file declares the pitch.
    noise : float
        Declared noise floor of the sensor; a hundred-thousandth of the range without.
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
        """Whether the axis is at once where its input puts it."""
        return self.mass == 0.0

    @classmethod
    def of(cls, axis: Axis) -> Self:
        """Gather the figures of an axis."""
        low, high = axis.range
        inputs = _inputs(axis)
        inertia = axis.inertia
        mass, damping, stiffness = inertia if inertia is not None else (0.0, 0.0, 0.0)
        rate = sqrt(stiffness / mass) if mass > 0.0 else 0.0
        pitch = axis.pitch if isinstance(axis, StepperAxis) else None
        steps = axis.steps_per_rev if isinstance(axis, StepperAxis) else None
        declared, pitch = pitch is not None, pitch or (high - low) / _PITCHES
        return cls(
            kind=axis.kind,
            unit=axis.unit or "m",
            low=low,
            high=high,
            span=high - low,
            input_low=inputs[0],
            input_high=inputs[1],
            input_span=inputs[1] - inputs[0],
            gain=axis.gain,
            mass=mass,
            damping=damping,
            stiffness=stiffness,
            free_damping=0.0 if stiffness > 0.0 else damping,
            frequency_hz=rate / (2.0 * pi),
            damping_ratio=damping / (2.0 * mass * rate) if rate > 0.0 else 0.0,
            pace_hz=rate / (2.0 * pi) or _PACE_HZ,
            force=_force(axis, stiffness, inputs),
            pitch=pitch,
            full_step=pitch / (steps or _STEPS_PER_PITCH),
            has_pitch=declared,
            noise=(axis.sensor.noise_floor if axis.sensor else 0.0) or _NOISE_SHARE * (high - low),
        )


def _inputs(axis: Axis) -> tuple[float, float]:
    """Return the ends of the input's range."""
    if not isinstance(axis, ForceAxis):
        reached = sorted(bound / axis.gain for bound in axis.range)
        low, high = axis.voltage_range or (reached[0], reached[1])
        return low, high
    if axis.voltage_range is not None:
        return axis.voltage_range
    limit = axis.controller.limit if axis.controller is not None else 10.0
    return -limit, limit


def _force(axis: Axis, stiffness: float, inputs: tuple[float, float]) -> float:
    if isinstance(axis, ForceAxis):
        return abs(axis.gain) * (inputs[1] - inputs[0])
    return _FORCE_SHARE * stiffness * axis.span
