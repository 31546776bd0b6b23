"""Information that a fit needs, in addition to the equations, to find an effect in records.

Each effect itself provides the start of a fit, the domain of its parameters, and the parameters
that differ from record to record. Effects of plugins are therefore found like built-in ones.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple, Protocol

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.records import Tap

Values = Mapping[str, float]
Signals = Mapping[Tap, FloatArray]
Interval = tuple[float, float]


class EffectSignature(StrEnum):
    """Trace in records of an effect that depends on chance or time, not on a command."""

    JUMPS = "jumps"
    TONES = "tones"
    SPIKES = "spikes"
    STEPS = "steps"
    NOISE = "noise"
    WANDER = "wander"


class RecordCoverage(NamedTuple):
    """Span of a set of records: smallest and largest command, m or rad; longest duration."""

    reach: Interval
    longest_s: float


class AxisRecord(NamedTuple):
    """Signals of one record that concern an axis, SI.

    ``command`` (n,); ``source`` (n,): command of the axis in which the effect originates, if
    recorded; ``real`` (n,) by tap: measurement; ``floor`` by tap: its noise floor; ``remainder``
    (n,) by tap: current remainder of the model, divided by the noise floor.
    """

    time_s: FloatArray
    command: FloatArray
    source: FloatArray | None
    real: Signals
    floor: Mapping[Tap, float]
    remainder: Signals


class FitView(Protocol):
    """Records and current remainders of the model, from which a fit starts.

    A view is made for one formulation of an effect. ``values`` are its parameters, presets
    included. ``starts_from_other_fit`` tells whether any of them come from the fit of another
    formulation.
    """

    @property
    def facts(self) -> AxisProperties:
        """Properties of the axis."""

    @property
    def values(self) -> Values:
        """All parameters, SI."""

    @property
    def starts_from_other_fit(self) -> bool:
        """Whether parameters come from the fit of another formulation."""

    @property
    def extent(self) -> RecordCoverage:
        """Range of commands and time that the records cover."""

    @property
    def records(self) -> Sequence[AxisRecord]:
        """The records."""

    @property
    def answers(self) -> Sequence[Signals]:
        """The model's response (n,) to each record, SI; this runs a simulation."""

    @property
    def untuned(self) -> tuple[Sequence[Signals], Sequence[Signals]]:
        """Responses and remainders, by record, with the model's original parameters."""

    def bounds(self, name: str) -> Interval:
        """Return the bounds of a parameter on this axis, SI."""

    def domain(self, name: str) -> Interval:
        """Return the range in which a fit to these records may vary a parameter, SI."""

    def periods(self, bounds: Interval) -> Sequence[float]:
        """Return the position periods, m or rad, of the strongest lines of the remainder."""

    def frequency(self, bounds: Interval) -> float | None:
        """Return the frequency, Hz, of the strongest line in time of the remainder."""

    def grid(
        self, bounds: Interval, origin: float, gain: float, *, at_input: bool
    ) -> Values | None:
        """Return ``step`` and ``shift`` of the quantization grid in the remainder, if any.

        The grid lies over the command (``at_input``) or in the reading. ``bounds`` of its step and
        its ``origin`` are in m or rad; ``gain`` converts to the unit of ``step``.
        """


Starts = Callable[[FitView], Iterable[Values]]
Domain = Interval | Callable[[Values, AxisProperties, Interval, RecordCoverage], Interval]


def start_from_presets(_view: FitView) -> Iterator[Values]:
    """Yield the presets as the only start."""
    yield {}


@dataclass(frozen=True, slots=True)
class RetunedParameters:
    """Parameters of the model that a formulation re-tunes, with their values in the model."""

    formulation: str | None
    values: Values


def retune_nothing(_facts: AxisProperties) -> RetunedParameters | None:
    """Return None: the effect re-tunes no parameter of the model."""
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class IdentificationHints:
    """Hints for finding an effect in records.

    Attributes
    ----------
    starts : callable
        Yields parameters, SI, from which a fit is tried. Omitted parameters have their presets.
    domain : mapping
        Range in which a fit may vary a parameter, SI, by parameter name, if it differs from the
        bounds: an interval, or a function of values, axis properties, bounds and record coverage.
    retunes : callable
        Returns the parameters of the model itself that the effect changes on an axis. The effect is
        then fitted together with every other effect, and counts as a cause only for the part of the
        gap that it alone closes.
    stepped : bool
        Whether the effect acts by jumps on a grid. Derivatives with respect to its parameters are
        then useless in a joint fit.
    of_the_record : frozenset of str
        Parameters that differ from record to record, such as the phase of an effect fixed in time.
    moved : callable, optional
        For effects locked to the position: converts parameters to a record whose position is
        smaller by the given offset, m or rad.
    shows_as : EffectSignature, optional
        The trace by which the effect is found if it does not follow from commands.
    fitted : bool
        Whether the effect can be fitted to a response; otherwise only its trace can be found.
    scout : str, optional
        The formulation that is examined first if none is quick to simulate.
    shown_at_rest : frozenset of str
        Formulations that only an axis that is held can show, because on a moving one another effect
        has the same shape.
    from_other : callable, optional
        Converts the fitted parameters of another formulation to the start of this one.
    lateness_s : callable, optional
        Returns the delay that the effect adds to a signal, s, from its parameters.
    """

    starts: Starts = start_from_presets
    domain: Mapping[str, Domain] = field(default_factory=dict)
    retunes: Callable[[AxisProperties], RetunedParameters | None] = retune_nothing
    stepped: bool = False
    of_the_record: frozenset[str] = frozenset()
    moved: Callable[[Values, float], Values] | None = None
    shows_as: EffectSignature | None = None
    fitted: bool = True
    scout: str | None = None
    shown_at_rest: frozenset[str] = frozenset()
    from_other: Callable[[Values], Values] | None = None
    lateness_s: Callable[[Values], float] | None = None

    @property
    def is_retuning(self) -> bool:
        """Whether the effect changes parameters that the model itself has."""
        return self.retunes is not retune_nothing


if not TYPE_CHECKING:
    AxisRecord.left = FormerMember("remainder")
    __getattr__ = serve_former_names(
        __name__,
        Extent="RecordCoverage",
        Identification="IdentificationHints",
        Retuning="RetunedParameters",
        Seen="AxisRecord",
        Sign="EffectSignature",
        View="FitView",
        nothing_own="retune_nothing",
        presets="start_from_presets",
    )
