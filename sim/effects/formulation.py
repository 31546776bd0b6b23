"""The parts of an effect: its parameters, and its action on a signal.

An :class:`Effect` has one or more :class:`Formulation` objects, which describe it by different
equations. A formulation *acts* in one of these ways:

=================== =============================================================================
`InputFunction`     on the input of an axis, held for ``h`` seconds: electronics, actuator
`ForceFunction`     on the axis as a force: friction, contact
`PositionFunction`  on the position of an axis as seen from outside: backlash, screw error
`ReadingFunction`   on the reading of the axis' own sensor
`AddedStates`       by adding linear states, stepped exactly with the axis: flexible modes
`AxisChange`        by changing the properties of the axis itself: its resonance
`InputDelay`        by delaying inputs
`ClockSkew`         by stamping readings with a clock that runs fast or slow
=================== =============================================================================

The first four are step functions ``step(x, other, t, h, a, b, p, s)``, which
:mod:`rotemina.sim.effects.step` describes. Their classes say what ``x``, ``other``, ``h``, ``a``
and ``b`` mean.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.identification import IdentificationHints
from rotemina.sim.effects.kinship import EffectRelations
from rotemina.sim.effects.step import StepFunction
from rotemina.sim.plugin_points import API_VERSIONS
from rotemina.sim.robot import Axis

Values = Mapping[str, float]


class EffectStage(StrEnum):
    """Stage of the signal chain in which an effect acts."""

    ELECTRONICS = "electronics"
    ACTUATOR = "actuator"
    MECHANICS = "mechanics"
    SENSOR = "sensor"


class EffectTrait(StrEnum):
    """Property that distinguishes an effect, and that the effect's check measures.

    The *deviation* is the motion or reading with the effect minus that without it.

    ``LINEAR``: the deviation obeys superposition. ``MEMORYLESS``: at rest, the deviation depends
    only on the command, not on the path to it. ``RATE_INDEPENDENT``: the deviation along a slow
    path does not depend on the speed. ``TRANSIENT``: there is no deviation at rest.
    ``LOCKED_TO_TIME``: the effect also acts at rest, and in the same way for any command.
    ``LOCKED_TO_POSITION``: the deviation depends only on the position, at any speed and in both
    directions. ``READING_ONLY``: the true motion does not change. ``RANDOM``: the deviation differs
    from seed to seed, and is absent without a seed. ``DISSIPATIVE``: the effect never adds energy.
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
class EffectParameter:
    """Parameter of a formulation.

    Attributes
    ----------
    name, meaning : str
    unit : str
        ``q`` stands for the axis' unit of position, ``u`` for that of its input and ``N`` for that
        of its force (``N`` or ``N m``). The text is empty for a pure number.
    low, high, typical : float
        Bounds, and the preset.
    per : str, optional
        Name of the property in :class:`~rotemina.sim.effects.AxisProperties` by whose
        magnitude ``low``, ``high`` and ``typical`` are multiplied.
    spare : str, optional
        Name of the axis property that this parameter adds to, such as the damping. Because the
        nominal axis already has that amount, the value may fall below ``low`` by the same amount.
    linear : bool
        Whether the effect is linear in this parameter, which may have either sign. A fit then
        solves for it instead of searching.
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

    def scale(self, facts: AxisProperties) -> float:
        """Return the factor by which bounds and preset are multiplied on this axis."""
        return abs(float(getattr(facts, self.per))) if self.per is not None else 1.0

    def bounds(self, facts: AxisProperties) -> tuple[float, float]:
        """Return the smallest and largest value on this axis, SI."""
        scale = self.scale(facts)
        return self.low * scale - self.compute_spare(facts), self.high * scale

    def compute_spare(self, facts: AxisProperties) -> float:
        """Return how far the value may fall below ``low`` on this axis, SI."""
        return float(getattr(facts, self.spare)) if self.spare is not None else 0.0

    def preset(self, facts: AxisProperties) -> float:
        """Return the typical value on this axis, SI."""
        return self.typical * self.scale(facts)

    def unit_on(self, facts: AxisProperties) -> str:
        """Return the unit, with its letters ``q``, ``u`` and ``N`` replaced for this axis."""
        names = {
            "q": facts.unit,
            "u": facts.unit if facts.kind == "stepper" else "V",
            "N": "N" if facts.unit == "m" else "N m",
        }
        return "".join(names.get(part, part) for part in _split_unit(self.unit))

    # Former names, which work for one more release.
    spared = FormerMember("compute_spare")


def _split_unit(unit: str) -> list[str]:
    tokens, word = [], ""
    for character in unit:
        if character.isalpha():
            word += character
            continue
        tokens += [word, character]
        word = ""
    return [*tokens, word]


def allow_any_step(_values: Values, _facts: AxisProperties) -> float:
    """Return infinity: no step shorter than the sampling interval is needed."""
    return inf


@dataclass(frozen=True, slots=True, kw_only=True)
class InputFunction:
    """Step function on the input of an axis.

    In the stage ``ELECTRONICS``, ``x`` is the input itself: V, or the commanded position of a
    stepper. In the stage ``ACTUATOR``, ``x`` is the requested position (V on a force axis). ``x``
    is held for the next ``h`` seconds, and the function returns the mean of its output during that
    time. With ``h = 0`` no time passes: the function returns its output at this instant, and must
    not change its memory. Only a rate-independent memory, such as that of hysteresis, may follow
    ``x``. ``other`` is the current position of the axis.

    ``timed``: the output changes while the input is held, so the function is called at every inner
    step.
    """

    step: StepFunction
    states: int = 0
    timed: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceFunction:
    """Step function that returns a force on the axis, held for the next ``h`` seconds.

    ``x`` is the position at mid-step and ``other`` the speed at the end of the step, both without
    this force. The arguments ``a`` and ``b`` are the displacement and the change of speed that a
    unit force would cause by the end of the step. At mid-step the displacement is about ``a/2``.
    With these, the function can solve for stiff forces, and dry friction can hold the axis exactly.
    """

    step: StepFunction
    states: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class PositionFunction:
    """Step function on the position of an axis; ``h`` is the time since the last call.

    ``other`` is the position of ``from_axis``, or 0 if the effect has none.
    """

    step: StepFunction
    states: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadingFunction:
    """Step function on the reading of a sensor; ``h`` is the time since the last call.

    ``other`` is the true position. ``random``: the argument ``a`` is a standard normal variate (0
    in a run without noise), and the function is called only at samples. ``digital``: the input
    already contains the sensor's own noise, offset and resolution, and the function is called only
    at samples.
    """

    step: StepFunction
    states: int = 0
    random: bool = False
    digital: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class LinearPart:
    """Added states z (n,) of an axis at q with input U, and their effect on the axis.

    ::

        ż = A z + B [q, q̇, U],   force = K z + L [q, q̇],   position = (1 − s) q + R z

    U is in the unit of position (V on a force axis). At rest the force must be zero. The last
    equation holds without a ``from_axis``: the added states replace the share s of the motion. With
    a ``from_axis``, the position of that axis stays q, and ``s q + R z`` is added to the position
    of the axis that carries the effect.

    Attributes: ``a`` (n, n) is A, ``b`` (n, 3) is B, ``force`` (n,) is the gain K, ``reaction``
    (2,) is the gain L, ``output`` (n,) is the gain R, and ``share`` is s.
    """

    a: FloatArray
    b: FloatArray
    output: FloatArray
    share: float = 0.0
    force: FloatArray | None = None
    reaction: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class AddedStates:
    """Linear states added to those of the axis, or of ``from_axis`` if the effect has one."""

    part: Callable[[Values, AxisProperties], LinearPart]


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisChange:
    """Replacement of the nominal axis by another one."""

    change: Callable[[Values, Axis], Axis]


@dataclass(frozen=True, slots=True, kw_only=True)
class InputDelay:
    """Delay of all inputs by ``delay_s``."""

    delay_s: Callable[[Values], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class ClockSkew:
    """Clock drift: the reading at the time t of a run shows the motion at ``(1 − rate) t``."""

    rate: Callable[[Values], float]


Action = (
    InputFunction
    | ForceFunction
    | PositionFunction
    | ReadingFunction
    | AddedStates
    | AxisChange
    | InputDelay
    | ClockSkew
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Formulation:
    """Effect described by one set of equations.

    Attributes
    ----------
    name, equation, source : str
    parameters : tuple of EffectParameter
    acts : Action
        Where in the signal chain the formulation acts, and how.
    traits : frozenset of EffectTrait
        Traits that the effect's check measures.
    prepare : callable
        Computes the argument ``p`` of the step function from the values and the axis properties. By
        default these are the values in the order of ``parameters``.
    inner_step_s : callable
        Returns the longest step at which the formulation is accurate, from the same arguments
        as ``prepare``.
    kinds : frozenset of str
        Axis kinds to which this formulation applies; if empty, those of the effect.
    by_spectra : bool
        Whether a diagnosis finds all parameters together from spectra, not by a search.
    """

    name: str
    equation: str
    source: str
    parameters: tuple[EffectParameter, ...]
    acts: Action
    traits: frozenset[EffectTrait] = frozenset()
    prepare: Callable[[Values, AxisProperties], Sequence[float]] | None = None
    inner_step_s: Callable[[Values, AxisProperties], float] = allow_any_step
    kinds: frozenset[str] = frozenset()
    by_spectra: bool = False

    def compute_numbers(self, values: Values, facts: AxisProperties) -> FloatArray:
        """Return the argument ``p`` of the step function."""
        if self.prepare is not None:
            return np.asarray(self.prepare(values, facts), dtype=np.float64)
        return np.array([values[p.name] for p in self.parameters], dtype=np.float64)

    def find_parameter(self, name: str) -> EffectParameter | None:
        """Return the parameter of this name, or None."""
        return next((p for p in self.parameters if p.name == name), None)

    # Former names, which work for one more release.
    numbers = FormerMember("compute_numbers")
    parameter = FormerMember("find_parameter")


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """Effect of the catalogue.

    Attributes
    ----------
    id, title, summary : str
        The id in reports and files, the name on screens, and the feature that distinguishes it.
    stage : EffectStage
    kinds : frozenset of str
        Axis kinds to which the effect applies.
    formulations : tuple of Formulation
        The first is the default.
    coupled : bool
        Whether the effect needs a ``from_axis``.
    identification : IdentificationHints
        How a fit finds the effect in records.
    kinship : EffectRelations
        How the effect relates to other effects.
    api_version : int
        The version of this interface that the effect was written for.
    """

    id: str
    title: str
    summary: str
    stage: EffectStage
    kinds: frozenset[str]
    formulations: tuple[Formulation, ...]
    coupled: bool = False
    identification: IdentificationHints = field(default_factory=IdentificationHints)
    kinship: EffectRelations = field(default_factory=EffectRelations)
    api_version: int = API_VERSIONS["rotemina.effects"]

    def find_formulation(self, name: str | None = None) -> Formulation | None:
        """Return the formulation of this name, by default the first one, or None."""
        if name is None:
            return self.formulations[0]
        return next((f for f in self.formulations if f.name == name), None)

    # Former names, which work for one more release.
    formulation = FormerMember("find_formulation")


EVERY_KIND = frozenset({"piezo", "stepper", "force"})

if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Change="AxisChange",
        Drive="InputFunction",
        Force="ForceFunction",
        Late="InputDelay",
        Motion="PositionFunction",
        Parameter="EffectParameter",
        Part="AddedStates",
        Reading="ReadingFunction",
        Skew="ClockSkew",
        Stage="EffectStage",
        Trait="EffectTrait",
        no_inner_step="allow_any_step",
    )
