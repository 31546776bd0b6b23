"""An effect that a machine's model lacks: where in the signal chain it acts, and its size."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Literal, Self

import numpy as np

from rotemina.sim.arrays import FloatArray


class SignalStage(Enum):
    """The place in the signal chain where an effect acts, in the order of the signal."""

    DRIVE = "output of the amplifier"
    ACTUATOR = "position that the actuator drives the axis to"
    STRUCTURE = "masses, dampers and springs"
    LOAD = "force on the axis"
    MOTION = "motion added to that of the axis"
    SENSOR = "output of the sensor before it is sampled"
    READING = "sampled reading"


@dataclass(frozen=True, slots=True)
class BlindAxis:
    """Properties of an axis that effects need, in SI units.

    Attributes
    ----------
    name, kind : name and kind of the axis in the robot file.
    index : column of the axis in every (n, m) array.
    low, span : start and length of the range.
    start, travel : lowest command of the case, and distance to the highest command.
    floor : declared noise floor of the sensor.
    resolution, noise : step and rms noise of the sensor.
    mass, damping, stiffness : parameters of the nominal axis.
    pitch, full_step : screw pitch and full step of a stepper; 0 for other axes.
    """

    name: str
    index: int
    kind: Literal["piezo", "stepper", "force"]
    low: float
    span: float
    start: float
    travel: float
    floor: float
    resolution: float
    noise: float
    mass: float
    damping: float
    stiffness: float
    pitch: float = 0.0
    full_step: float = 0.0


@dataclass(frozen=True, slots=True)
class SimulationRun:
    """The time grid and the random numbers of one simulated record.

    ``lead`` is the number of fine steps of ``step_s`` in the lead-in before the first sample of the
    record. Each sample takes ``rows_per_sample`` fine steps. ``seed`` differs from record to
    record.
    """

    step_s: float
    rows_per_sample: int
    lead: int
    seed: int

    def make_generator(self, part_seed: int) -> np.random.Generator:
        """Return the random generator of one effect in this record, the same at each call."""
        return np.random.default_rng((self.seed, part_seed))

    def hold_before_record(self, values: FloatArray) -> FloatArray:
        """Return ``values`` (n, …), with the lead-in replaced by the first sample of the record."""
        out = values.copy()
        out[: self.lead] = values[self.lead]
        return out


# The first argument and the result of `act` depend on the stage:
#   DRIVE, ACTUATOR, SENSOR  (n,) signal on the fine grid -> changed signal (n,)
#   MOTION                   (n, m) motion of all axes -> (n,) motion to add to this axis
#   READING                  (n,) true position at the samples -> reading (n,)
#   LOAD, STRUCTURE          (0,), unused -> row of numbers for `mechanics`
EffectFunction = Callable[[FloatArray, SimulationRun, float], FloatArray]


@dataclass(frozen=True, slots=True)
class EffectPart:
    """One effect on one axis; ``sizes`` are the bounds of ``size``."""

    effect: str
    axis: BlindAxis
    stage: SignalStage
    act: EffectFunction
    sizes: tuple[float, float]
    size: float = 0.0
    from_axis: str | None = None

    def with_size(self, size: float) -> Self:
        """Return a copy with another size, clipped to the bounds."""
        return replace(self, size=float(np.clip(size, *self.sizes)))
