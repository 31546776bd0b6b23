"""Information that a fit needs to find an effect in records, besides its equations.

Each effect itself provides the start of a fit, the domain of its parameters, and the parameters of
a single record, so effects of plugins are found like built-in ones.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple, Protocol

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.records.record import Tap

Values = Mapping[str, float]
Signals = Mapping[Tap, FloatArray]
Interval = tuple[float, float]


class Sign(StrEnum):
    """The trace of an effect that only chance or time determines, and no command predicts."""

    JUMPS = "jumps"
    TONES = "tones"
    SPIKES = "spikes"
    STEPS = "steps"
    NOISE = "noise"
    WANDER = "wander"


class Extent(NamedTuple):
    """What records cover: the least and the greatest command, m or rad; the longest's time."""

    reach: Interval
    longest_s: float


class Seen(NamedTuple):
    """The part of one record that concerns an axis, SI.

    ``command`` (n,); ``source`` (n,): command of the axis in which an effect originates, if
    recorded; ``real`` (n,) by tap: measurement; ``floor``: its noise; ``left`` (n,) by tap: present
    remainder of the model, over the floor.
    """

    time_s: FloatArray
    command: FloatArray
    source: FloatArray | None
    real: Signals
    floor: Mapping[Tap, float]
    left: Signals


class View(Protocol):
    """The data for the start of a fit: records, and the present remainders of the model.

    It is made for one formulation of an effect: ``values`` are its parameters, presets included,
    and ``given`` tells whether any came from another, fitted formulation.
    """

    @property
    def facts(self) -> Facts:
        """The axis."""

    @property
    def values(self) -> Values:
        """All parameters, SI."""

    @property
    def given(self) -> bool:
        """Whether the parameters are those of another formulation as fitted."""

    @property
    def extent(self) -> Extent:
        """What the records cover."""

    @property
    def records(self) -> Sequence[Seen]:
        """The records."""

    @property
    def answers(self) -> Sequence[Signals]:
        """The model's answer for each record (n,), SI; runs a simulation."""

    @property
    def unbent(self) -> tuple[Sequence[Signals], Sequence[Signals]]:
        """Answers and remainders, by record, with the model's original own parameters."""

    def bounds(self, name: str) -> Interval:
        """Return the bounds of a parameter on this axis, SI."""

    def domain(self, name: str) -> Interval:
        """Return how far a fit to these records may take a parameter, SI."""

    def periods(self, bounds: Interval) -> Sequence[float]:
        """Return periods over position of the strongest lines of the remainder, m or rad."""

    def frequency(self, bounds: Interval) -> float | None:
        """Return the frequency of the strongest line over time of the remainder, Hz."""

    def grid(
        self, bounds: Interval, origin: float, gain: float, *, at_input: bool
    ) -> Values | None:
        """Return ``step`` and ``shift`` of the teeth in the remainder, if there are any.

        They are ``at_input``, over the command, or in the reading. ``bounds`` of their width and
        their ``origin`` are in m or rad; ``gain`` converts the step's own unit.
        """


Starts = Callable[[View], Iterable[Values]]
Domain = Interval | Callable[[Values, Facts, Interval, Extent], Interval]


def presets(_view: View) -> Iterator[Values]:
    """Begin with the presets."""
    yield {}


@dataclass(frozen=True, slots=True)
class Retuning:
    """The model's own parameters that a formulation re-tunes, as the model has them."""

    formulation: str | None
    values: Values


def nothing_own(_facts: Facts) -> Retuning | None:
    """Return that an effect re-tunes no parameter of the model."""
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Identification:
    """How an effect is found in records.

    Attributes
    ----------
    starts : callable
        Gives parameters, SI, from which a fit is tried; those left out have their preset.
    domain : mapping
        By parameter how far a fit may take it, SI, where its bounds are not the answer: an
        interval, or a function of values, facts, bounds and what the records cover.
    retunes : callable
        Tells, on an axis, which of the model's own numbers the effect changes: it is fitted beside
        every other one then, and counts as a cause only by what it closes itself.
    stepped : bool
        Whether it acts by jumps on a grid: slopes over its parameters tell nothing beside others.
    of_the_record : frozenset of str
        Parameters that each record has for itself, as the phase of what is fixed in time.
    moved : callable, optional
        Of what is locked to the position: makes of parameters those of a record that counts its
        place from elsewhere, by so much less, m or rad.
    shows_as : Sign, optional
        How it is found where it does not follow from commands.
    fitted : bool
        Whether it can be fitted to a response, and not only be found by its sign.
    scout : str, optional
        The formulation that is examined first where none is quick to simulate.
    from_other : callable, optional
        Makes parameters of another formulation, as fitted, those from which this one begins.
    lateness_s : callable, optional
        How late it makes a signal, s, by its parameters.
    """

    starts: Starts = presets
    domain: Mapping[str, Domain] = field(default_factory=dict)
    retunes: Callable[[Facts], Retuning | None] = nothing_own
    stepped: bool = False
    of_the_record: frozenset[str] = frozenset()
    moved: Callable[[Values, float], Values] | None = None
    shows_as: Sign | None = None
    fitted: bool = True
    scout: str | None = None
    from_other: Callable[[Values], Values] | None = None
    lateness_s: Callable[[Values], float] | None = None

    @property
    def is_retuning(self) -> bool:
        """Whether the effect changes numbers that the model has itself."""
        return self.retunes is not nothing_own
