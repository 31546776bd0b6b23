"""The parts of an effect: its parameters, and its action on a signal.

An :class:`Effect` has one or several :class:`Formulation`, each the same effect by other
equations. A formulation *acts* in one of these ways:

========== ======================================================================================
`Drive`    on the input of an axis, held while ``h`` lasts: electronics, actuator
`Force`    on the axis as a force: friction, contact
`Motion`   on the position that an axis takes, seen from outside: backlash, screw
`Reading`  on what the axis' own sensor says
`Part`     as further linear states, stepped exactly with the axis': flexible modes
`Change`   by other figures of the axis itself: its resonance
`Late`     by letting inputs act later
`Skew`     by stamping readings with a clock that runs fast or slow
========== ======================================================================================
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.identification import Identification
from rotemina.sim.effects.kinship import Kinship
from rotemina.sim.effects.step import StepFunction
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.robot.model import Axis

Values = Mapping[str, float]


class Stage(StrEnum):
    """Where in the signal chain an effect lives."""

    ELECTRONICS = "electronics"
    ACTUATOR = "actuator"
    MECHANICS = "mechanics"
    SENSOR = "sensor"


class Trait(StrEnum):
    """A property that sets an effect apart, and that the effect's check measures.

    ``LINEAR``: what it adds obeys superposition. ``MEMORYLESS``: at rest, what it adds depends on
    the command alone, whatever came before. ``RATE_INDEPENDENT``: a slow path leaves the same
    trace at any pace. ``TRANSIENT``: adds nothing at rest. ``LOCKED_TO_TIME``: acts without
    motion, and the same whatever the command. ``LOCKED_TO_POSITION``: what it adds depends on the
    position alone, at any speed and either way. ``READING_ONLY``: the true motion stays as it is.
    ``RANDOM``: differs from seed to seed, and is absent without one.
    ``DISSIPATIVE``: never adds energy.
    """

    LINEAR = "linear"
    MEMORYLESS = "memoryless"
    RATE_INDEPENDENT = "rate-independent"
    TRANSIENT = "transient"
    LOCKED_TO_TIME = "locked to time"
    LOCKED_TO_POSITION = "locked to position"
    READING_ONLY = "reading only"
    RANDOM = "random"
    DISSIPATIVE = "dissipative"


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a formulation.

    Attributes
    ----------
    name, meaning : str
    unit : str
        With ``q`` for the axis' unit of position, ``u`` for that of its input and ``N`` for that
        of its force (``N`` or ``N m``); empty for a pure number.
    low, high, typical : float
        Bounds, and the preset.
    per : str, optional
        A figure of :class:`~rotemina.sim.effects.facts.Facts` that these three are multiples of.
    spare : str, optional
        A figure by which it may be less: what the axis itself has of it already.
    linear : bool
        Whether it is an amount of either sign in which the effect is linear, so that a fit needs
        no search for it.
    """

    name: str
    meaning: str
    unit: str
    low: float
    high: float
    typical: float
    per: str | None = None
    spare: str | None = None
    linear: bool = False

    def scale(self, facts: Facts) -> float:
        """Return what bounds and preset are multiples of, on this axis."""
        return abs(float(getattr(facts, self.per))) if self.per is not None else 1.0

    def bounds(self, facts: Facts) -> tuple[float, float]:
        """Return the least and greatest value on this axis, SI."""
        scale = self.scale(facts)
        return self.low * scale - self.spared(facts), self.high * scale

    def spared(self, facts: Facts) -> float:
        """Return by how much it may be less on this axis, SI."""
        return float(getattr(facts, self.spare)) if self.spare is not None else 0.0

    def preset(self, facts: Facts) -> float:
        """Return the typical value on this axis, SI."""
        return self.typical * self.scale(facts)

    def unit_on(self, facts: Facts) -> str:
        """Return the unit on this axis."""
        names = {
            "q": facts.unit,
            "u": facts.unit if facts.kind == "stepper" else "V",
            "N": "N" if facts.unit == "m" else "N m",
        }
        return "".join(names.get(part, part) for part in _tokens(self.unit))


def _tokens(unit: str) -> list[str]:
    """Split ``"N s/q"`` into words and separators."""
    tokens, word = [], ""
    for letter in unit:
        if letter.isalpha():
            word += letter
            continue
        tokens += [word, letter]
        word = ""
    return [*tokens, word]


def no_inner_step(_values: Values, _facts: Facts) -> float:
    """Return that steps from sample to sample will do."""
    return inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """A step function on the input of an axis.

    Electronics see ``x`` in the unit of the input (V; position of a stepper), actuators as the
    requested position (V on a force axis). ``x`` is held for the next ``h`` seconds, and the answer
    is the mean of the output meanwhile. With ``h = 0`` the function reads: it returns its output at
    this instant and changes no state; a memory without time may follow ``x``. ``other`` is the
    present position of the axis.

    ``timed``: the output moves while the input is held, so it is called at every inner step.
    """

    step: StepFunction
    states: int = 0
    timed: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Force:
    """A step function that answers a force on the axis, held for the next ``h`` seconds.

    ``x`` is the position at mid-step and ``other`` the speed at its end, both without this force;
    a unit force would move the position at the end of the step by ``a`` (so at mid-step by about
    ``a/2``) and the speed there by ``b``. With these, stiff forces can be solved for and dry
    friction can hold exactly.
    """

    step: StepFunction
    states: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """A step function on the position of an axis; ``h`` is the time since it was last called.

    ``other`` is the position of ``from_axis``, 0 where the effect names none.
    """

    step: StepFunction
    states: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """A step function on the reading of a sensor; ``h`` is the time since the last call.

    ``other`` is the true position. ``random``: ``a`` is a standard normal variate, 0 without
    chance, and the function is called only at samples. ``digital``: its input already contains the
    sensor's own noise, offset and resolution, and it is called only at samples.
    """

    step: StepFunction
    states: int = 0
    random: bool = False
    digital: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class LinearPart:
    """Further states z (n,) of an axis at q under the input U, and their effect on it.

    ::

        ż = A z + B [q, q̇, U],   force = K z + L [q, q̇],   position = (1 − r) q + R z

    where U is in the unit of position (V on a force axis). At rest the force must be zero. With
    ``port`` the position of the axis itself stays q, and ``R z + r q`` leaks from it into the axis
    that carries the effect.

    Attributes: ``a`` (n, n), ``b`` (n, 3), ``force`` (n,), ``reaction`` (2,), ``output`` (n,),
    ``share`` r.
    """

    a: FloatArray
    b: FloatArray
    output: FloatArray
    share: float = 0.0
    force: FloatArray | None = None
    reaction: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """Linear states added to those of the axis, or of ``from_axis`` if they leak from it."""

    part: Callable[[Values, Facts], LinearPart]


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Another axis in place of the nominal one."""

    change: Callable[[Values, Axis], Axis]


@dataclass(frozen=True, slots=True, kw_only=True)
class Late:
    """Inputs that act later by ``delay_s``."""

    delay_s: Callable[[Values], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Skew:
    """Readings taken later by ``rate`` seconds for each second of the run."""

    rate: Callable[[Values], float]


Action = Drive | Force | Motion | Reading | Part | Change | Late | Skew


@dataclass(frozen=True, slots=True, kw_only=True)
class Formulation:
    """An effect by one set of equations.

    Attributes
    ----------
    name, equation, source : str
    parameters : tuple of Parameter
    acts : Action
    traits : frozenset of Trait
        What the effect's check measures.
    prepare : callable
        Makes the numbers ``p`` of a step function from values and facts; by default the values
        in the order of ``parameters``.
    inner_step_s : callable
        The longest step with which it is accurate, from values and facts.
    kinds : frozenset of str
        Axis kinds that can carry it; empty for all those of its effect.
    by_spectra : bool
        Whether a diagnosis finds its many parameters at once, from spectra, and not by a search.
    """

    name: str
    equation: str
    source: str
    parameters: tuple[Parameter, ...]
    acts: Action
    traits: frozenset[Trait] = frozenset()
    prepare: Callable[[Values, Facts], Sequence[float]] | None = None
    inner_step_s: Callable[[Values, Facts], float] = no_inner_step
    kinds: frozenset[str] = frozenset()
    by_spectra: bool = False

    def numbers(self, values: Values, facts: Facts) -> FloatArray:
        """Return the argument ``p`` of the step function."""
        if self.prepare is not None:
            return np.asarray(self.prepare(values, facts), dtype=np.float64)
        return np.array([values[p.name] for p in self.parameters], dtype=np.float64)

    def parameter(self, name: str) -> Parameter | None:
        """Return a parameter by name, or None."""
        return next((p for p in self.parameters if p.name == name), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """One effect of the catalogue.

    Attributes
    ----------
    id, title, summary : str
        The id of reports and files, a name for screens, and what sets the effect apart.
    stage : Stage
    kinds : frozenset of str
        Axis kinds that can carry it.
    formulations : tuple of Formulation
        The first is the usual one.
    coupled : bool
        Whether it needs a ``from_axis``.
    identification : Identification
        How it is found in records.
    kinship : Kinship
        How it stands to others.
    api_version : int
        The version of this interface that the effect was written for.
    """

    id: str
    title: str
    summary: str
    stage: Stage
    kinds: frozenset[str]
    formulations: tuple[Formulation, ...]
    coupled: bool = False
    identification: Identification = field(default_factory=Identification)
    kinship: Kinship = field(default_factory=Kinship)
    api_version: int = API_VERSIONS["rotemina.effects"]

    def formulation(self, name: str | None = None) -> Formulation | None:
        """Return a formulation by name, by default the usual one, or None."""
        if name is None:
            return self.formulations[0]
        return next((f for f in self.formulations if f.name == name), None)


EVERY_KIND = frozenset({"piezo", "stepper", "force"})
