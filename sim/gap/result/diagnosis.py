"""The result of a diagnosis: where the gap is, which effects cause it, and how much it shrinks.

:mod:`~rotemina.sim.gap.output.document` writes it as JSON.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.sim.gap.location import LocatedGap
from rotemina.sim.messages import Message
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect, Robot

# Used in place of an effect's id for a gap that no effect explains.
UNKNOWN_EFFECT_ID = "unknown"

Interval = tuple[float, float]


class GapVerdict(StrEnum):
    """The verdict on an axis or a robot; the members are ordered from certain to uncertain.

    ``PARTLY`` means that the causes are certain but do not explain the whole gap. ``FAILED`` says
    nothing about the machine: the program could not examine the axis.
    """

    NONE = "none"
    EXPLAINED = "explained"
    PARTLY = "partly"
    INSUFFICIENT = "insufficient_excitation"
    UNKNOWN = "unknown"
    FAILED = "failed"


# With these verdicts, the causes enter the corrected model.
CORRECTING_VERDICTS = (GapVerdict.EXPLAINED, GapVerdict.PARTLY)


@dataclass(frozen=True, slots=True)
class FittedParameter:
    """A fitted parameter of a cause.

    ``value`` and ``interval`` are in ``unit``, which is SI. The interval has 95 % confidence; it is
    None if the data do not bound the value. ``at_bound`` is "low" or "high" if the fit ended at a
    bound of the parameter.
    """

    name: str
    value: float
    unit: str
    interval: Interval | None = None
    at_bound: str | None = None


@dataclass(frozen=True, slots=True)
class DerivedFigure:
    """A figure that the records determine even if they do not determine its cause.

    ``value`` and its 95 % ``interval`` are in ``unit``, which is SI.
    """

    name: str
    value: float
    interval: Interval
    unit: str


@dataclass(frozen=True, slots=True)
class GapCause:
    """An effect that the model lacks, or :data:`UNKNOWN_EFFECT_ID`.

    Attributes
    ----------
    axis, effect, formulation, stage, tap, from_axis
        ``formulation`` and ``stage`` are None for :data:`UNKNOWN_EFFECT_ID`. The tap is the first
        measured tap at which the effect is visible.
    probability : float
        Calibrated probability that the named effect is really present
        (:mod:`~rotemina.sim.gap.compare.calibration`).
    weight : float, optional
        Probability of the effect relative to its rivals, from these records alone; None for
        :data:`UNKNOWN_EFFECT_ID`.
    ambiguous_with : tuple of str
        Other effects of the same axis that the data cannot distinguish from it, most likely first.
    gap_before, gap_after : float
        Rms of the gap at the tap, SI, on validation data, without and with this cause. All other
        causes are in the model in both cases.
    closed : float, optional
        ``1 − (after² − floor²)/(before² − floor²)``, limited to 0 … 1; None if there is no gap to
        close.
    closed_interval : tuple of float, optional
    parameters : tuple of FittedParameter
    derived : tuple of DerivedFigure
    in_model : bool
        Whether the corrected model uses the effect.
    """

    axis: str
    effect: str
    formulation: str | None
    stage: str | None
    tap: Tap
    from_axis: str | None
    probability: float
    ambiguous_with: tuple[str, ...]
    gap_before: float
    gap_after: float
    closed: float | None
    closed_interval: Interval | None
    parameters: tuple[FittedParameter, ...] = ()
    derived: tuple[DerivedFigure, ...] = ()
    in_model: bool = True
    weight: float | None = None


@dataclass(frozen=True, slots=True)
class SuspectedEffect:
    """An effect that may be present, but is too weak compared with the remainder to be a cause."""

    effect: str
    from_axis: str | None
    probability: float
    in_model: bool


@dataclass(frozen=True, slots=True)
class GapRemainder:
    """The unexplained gap of an axis above the noise floor, at the last tap, on validation data.

    ``rms`` is in SI; ``share`` is a fraction of the power of the gap. ``depends_on`` names the
    predictors that a probe found, most informative first, each with the fraction of the power that
    it predicts.
    """

    rms: float
    share: float
    depends_on: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, slots=True)
class ModelOffset:
    """A constant that is added to the corrected model at a tap, and its standard deviation, SI.

    It is the same in all records.
    """

    value: float
    deviation: float


@dataclass(frozen=True, slots=True)
class ShrinkageStep:
    """The gap with this effect and all before it in the model, and the effect's Shapley share."""

    effect: str
    axis: str
    rms: float
    shapley: float


@dataclass(frozen=True, slots=True)
class GapShrinkage:
    """The shrinkage of an axis' gap at a tap; all figures are rms on validation data, SI.

    Attributes
    ----------
    axis, tap
    raw, retuned, corrected : float
        The gap of the original model, of the model with its own parameters fitted, and of the model
        with all causes.
    floor, ceiling : float
        The noise floor, and the gap of a black-box model (None if there is none).
    closed : float, optional
    closed_interval : tuple of float, optional
    steps : tuple of ShrinkageStep
    """

    axis: str
    tap: Tap
    raw: float
    retuned: float
    corrected: float
    floor: float
    ceiling: float | None
    closed: float | None
    closed_interval: Interval | None
    steps: tuple[ShrinkageStep, ...]


@dataclass(frozen=True, slots=True)
class RankedCandidate:
    """A candidate that was tried in place of the leading cause.

    ``held_out_rms`` is the gap that remains with it on validation data, in noise floors.
    """

    effect: str
    formulation: str | None
    from_axis: str | None
    probability: float
    held_out_rms: float
    held_out_interval: Interval


@dataclass(frozen=True, slots=True)
class AxisDiagnosis:
    """The result for one axis.

    Attributes
    ----------
    axis, verdict, places, causes, shrinkage
    ranking : tuple of RankedCandidate
        Alternatives to the leading cause, most likely first.
    remarks : tuple of Message
        Full sentences, for example about masked samples and about the remainder.
    fitted : tuple of AxisEffect
        The effects that correct the model, including its re-tuned parameters.
    suspected : tuple of SuspectedEffect
    remainder : GapRemainder, optional
        None if there is no gap.
    offsets : mapping of Tap to ModelOffset or None
        Constant of each tap; None if the records disagree on it.
    """

    axis: str
    verdict: GapVerdict
    places: tuple[LocatedGap, ...]
    causes: tuple[GapCause, ...] = ()
    shrinkage: tuple[GapShrinkage, ...] = ()
    ranking: tuple[RankedCandidate, ...] = ()
    remarks: tuple[Message, ...] = ()
    fitted: tuple[AxisEffect, ...] = ()
    suspected: tuple[SuspectedEffect, ...] = ()
    remainder: GapRemainder | None = None
    offsets: Mapping[Tap, ModelOffset | None] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SuggestedExperiment:
    """A motion that would distinguish rival causes.

    Attributes
    ----------
    axis : str
    splits : tuple of str
        Ids of the effects that the motion distinguishes; empty if the records are too poor to name
        any.
    why : Message
        The reason, in one sentence.
    time_s : tuple of float
    commands : mapping axis -> tuple of float
        Commands, SI, of the same length as ``time_s``.
    predictions : mapping effect -> tuple of float
        Signal of the axis at ``tap`` that each rival predicts, SI.
    tap : Tap
        The reading of the sensor, or another channel to record if the reading cannot distinguish
        the rivals.
    """

    axis: str
    splits: tuple[str, ...]
    why: Message
    time_s: tuple[float, ...]
    commands: Mapping[str, tuple[float, ...]]
    predictions: Mapping[str, tuple[float, ...]]
    tap: Tap = Tap.MEAS


@dataclass(frozen=True, slots=True, order=True)
class FailedStep:
    """A computation that failed, and without which the diagnosis went on.

    Attributes
    ----------
    axis : str
    effects : tuple of str
        Ids of the effects that were tried together; empty if the whole examination of the axis
        failed.
    reason : str
    """

    axis: str
    effects: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """The complete result of a diagnosis.

    ``robot`` is the examined model, without the effects that the diagnosis adds. ``failed`` lists
    the candidates and axes whose computation failed.
    """

    robot: Robot
    axes: Mapping[str, AxisDiagnosis]
    experiments: tuple[SuggestedExperiment, ...] = field(default=())
    seed: int = 0
    failed: tuple[FailedStep, ...] = ()

    @property
    def verdict(self) -> GapVerdict:
        """Verdict on the robot: that of its least certain axis among those that were examined."""
        order = list(GapVerdict)
        verdicts = [axis.verdict for axis in self.axes.values()]
        examined = [verdict for verdict in verdicts if verdict is not GapVerdict.FAILED]
        return max(examined or verdicts, key=order.index, default=order[0])

    @property
    def is_complete(self) -> bool:
        """Whether every axis with a gap was examined."""
        return all(axis.verdict is not GapVerdict.FAILED for axis in self.axes.values())

    @property
    def places(self) -> tuple[LocatedGap, ...]:
        """Axes and taps whose gap is certainly above the floor, largest gap first."""
        places = [
            place for axis in self.axes.values() for place in axis.places if place.is_significant
        ]
        return tuple(sorted(places, key=lambda place: -place.excess))

    @property
    def causes(self) -> tuple[GapCause, ...]:
        """All causes, in the order of the axes."""
        return tuple(cause for axis in self.axes.values() for cause in axis.causes)

    @property
    def fitted(self) -> tuple[AxisEffect, ...]:
        """The effects that turn the model into the corrected model."""
        return tuple(effect for axis in self.axes.values() for effect in axis.fitted)
