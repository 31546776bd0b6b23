"""A part that a machine's model lacks: where in the chain it acts and how large it is."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Literal, Self

import numpy as np

from rotemina.sim.arrays import FloatArray


class Stage(Enum):
    """Where a part acts, in the order in which a signal passes."""

    DRIVE = "what the amplifier puts out"
    ACTUATOR = "where the actuator wants the axis"
    STRUCTURE = "masses, dampers and springs"
    LOAD = "a force on the axis"
    MOTION = "motion added to the axis'"
    SENSOR = "what the sensor passes on, before it is sampled"
    READING = "the sampled reading"


@dataclass(frozen=True, slots=True)
class Axis:
    """What a part needs to know of its axis, SI.

    Attributes
    ----------
    index : of the axis in the columns of every (n, m) array.
    low, span : start and length of the range.
    start, travel : lowest command of the case and distance to the highest.
    floor : declared noise floor.
    mass, damping, stiffness : of the nominal axis.
    pitch, full_step : of a stepper, 0 else.
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
    """One run through the machine: its fine time grid, and chance of its own.

    ``lead`` fine steps of ``step_s`` pass before the record's first sample; ``every`` fine steps
    make one sample. ``seed`` tells one record from another.
    """

    step_s: float
    every: int
    lead: int
    seed: int

    def chance(self, part_seed: int) -> np.random.Generator:
        """Return the chance of one part in this record, the same at each call."""
        return np.random.default_rng((self.seed, part_seed))

    def settled(self, values: FloatArray) -> FloatArray:
        """Return ``values`` (n, …) as if their first sample had lasted since long ago."""
        out = values.copy()
        out[: self.lead] = values[self.lead]
        return out


# What `act` takes and returns depends on the stage:
#   DRIVE, ACTUATOR, SENSOR  (n,) signal on the fine grid -> the same, changed
#   MOTION                   (n, m) motion of all axes -> (n,) what is added to this axis
#   READING                  (n,) true position at the samples -> reading
#   LOAD, STRUCTURE          (0,) -> the row of numbers that `mechanics` knows
Act = Callable[[FloatArray, SimulationRun, float], FloatArray]


@dataclass(frozen=True, slots=True)
class Part:
    """One effect as the generator makes it; ``sizes`` bound the plausible ``size``."""

    effect: str
    axis: Axis
    stage: Stage
    act: Act
    sizes: tuple[float, float]
    size: float = 0.0
    from_axis: str | None = None

    def sized(self, size: float) -> Self:
        """Return the same part with another size, held within its bounds."""
        return replace(self, size=float(np.clip(size, *self.sizes)))
