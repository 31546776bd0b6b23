"""The result of a diagnosis: where the gap lies, which effects cause it, how far it shrinks.

:mod:`~rotemina.sim.gap.output.document` writes these facts as JSON.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.sim.gap.location.located_gap import LocatedGap
from rotemina.sim.messages import Message
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect, Robot

UNKNOWN = "unknown"  # in place of an effect's id, for a gap that no effect explains

Interval = tuple[float, float]


class Verdict(StrEnum):
    """What can be said of an axis, or of a robot; in the order of how much is open.

    ``PARTLY``: causes are sure, and yet more is left than they can account for.
    """

    NONE = "none"
    EXPLAINED = "explained"
    PARTLY = "partly"
    INSUFFICIENT = "insufficient_excitation"
    UNKNOWN = "unknown"


CORRECTING = (Verdict.EXPLAINED, Verdict.PARTLY)  # whose causes make the corrected model


@dataclass(frozen=True, slots=True)
class FittedParameter:
    """One number of a cause.

    ``value`` and ``interval`` (95 %, None where the data do not bound it) in ``unit``, SI;
    ``at_bound`` is "low" or "high" where the fit ended at the parameter's bound.
    """

    name: str
    value: float
    unit: str
    interval: Interval | None = None
    at_bound: str | None = None


@dataclass(frozen=True, slots=True)
class Derived:
    """A figure that the records determine even if they leave its cause open.

    ``value`` and its 95 % ``interval`` in ``unit``, SI.
    """

    name: str
    value: float
    interval: Interval
    unit: str


@dataclass(frozen=True, slots=True)
class Cause:
    """An effect that the model lacks, or :data:`UNKNOWN`.

    Attributes
    ----------
    axis, effect, formulation, stage, tap, from_axis
        ``formulation`` and ``stage`` are None for :data:`UNKNOWN`. The tap is where the effect
        shows first, of those that were measured.
    probability : float
        How often what is named like this is there
        (:mod:`~rotemina.sim.gap.compare.calibration`).
    weight : float, optional
        Its share among its rivals on these records; None for :data:`UNKNOWN`.
    ambiguous_with : tuple of str
        Other effects of the same axis that the data cannot tell from it, likeliest first.
    gap_before, gap_after : float
        Rms at the tap, SI, on data that the fit did not see, with all other causes in: without and
        with this one.
    closed : float, optional
        ``1 − (after² − floor²)/(before² − floor²)``, within 0 and 1; None where there is no gap
        to close.
    closed_interval : tuple of float, optional
    parameters : tuple of FittedParameter
    derived : tuple of Derived
    in_model : bool
        Whether the corrected model uses it.
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
    derived: tuple[Derived, ...] = ()
    in_model: bool = True
    weight: float | None = None


@dataclass(frozen=True, slots=True)
class Suspected:
    """An effect that has weight but is small compared with the remainder; it is not a cause."""

    effect: str
    from_axis: str | None
    probability: float
    in_model: bool


@dataclass(frozen=True, slots=True)
class Remainder:
    """The remainder of an axis' gap at the last tap, on validation data, above the floor.

    ``rms`` in SI; ``share`` of the gap's power; ``depends_on`` names the predictors found by a
    probe, most informative first, with the share of the power that each predicts.
    """

    rms: float
    share: float
    depends_on: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Offset:
    """A constant, SI, by which the corrected model is moved at a tap, and its standard deviation.

    All records agree on it.
    """

    value: float
    deviation: float


@dataclass(frozen=True, slots=True)
class ShrinkageStep:
    """What is left at a tap once this effect and those before it are in, and its Shapley share."""

    effect: str
    axis: str
    rms: float
    shapley: float


@dataclass(frozen=True, slots=True)
class Shrinkage:
    """How far the gap of an axis at a tap shrinks; all rms, SI, on validation data.

    Attributes
    ----------
    axis, tap
    raw, retuned, corrected : float
        With the model as it was, with its own parameters fitted, with all causes in.
    floor, ceiling : float
        What noise leaves, and what a black-box model leaves (None where none could be made).
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
class Ranked:
    """An effect that was tried in place of the leading cause, likeliest first.

    ``held_out_rms`` is in floors, on data that its fit did not see, with its interval.
    """

    effect: str
    formulation: str | None
    from_axis: str | None
    probability: float
    held_out_rms: float
    held_out_interval: Interval


@dataclass(frozen=True, slots=True)
class AxisDiagnosis:
    """The result for one axis."""

    axis: str
    verdict: Verdict
    places: tuple[LocatedGap, ...]
    causes: tuple[Cause, ...] = ()
    shrinkage: tuple[Shrinkage, ...] = ()
    ranking: tuple[Ranked, ...] = ()
    remarks: tuple[
        Message, ...
    ] = ()  # whole sentences: on what a remainder depends, what was masked
    fitted: tuple[AxisEffect, ...] = ()  # what corrects the model, re-tuned parameters included
    suspected: tuple[Suspected, ...] = ()
    remainder: Remainder | None = None  # None where there is no gap
    offsets: Mapping[Tap, Offset | None] = field(default_factory=dict)  # None: records disagree


@dataclass(frozen=True, slots=True)
class Experiment:
    """An excitation that would distinguish rivals.

    Attributes
    ----------
    axis : str
    splits : tuple of str
        The rivals' ids; none where the records tell too little for rivals.
    why : Message
        One sentence.
    time_s : tuple of float
    commands : mapping axis -> tuple of float
        SI, of the same length as ``time_s``.
    predictions : mapping effect -> tuple of float
        What each rival says of the axis at ``tap``, SI.
    tap : Tap
        The sensor's reading, or where that cannot tell them apart, another channel to record.
    """

    axis: str
    splits: tuple[str, ...]
    why: Message
    time_s: tuple[float, ...]
    commands: Mapping[str, tuple[float, ...]]
    predictions: Mapping[str, tuple[float, ...]]
    tap: Tap = Tap.MEAS


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """The complete result.

    ``robot`` is the examined model, without the additions of the diagnosis.
    """

    robot: Robot
    axes: Mapping[str, AxisDiagnosis]
    experiments: tuple[Experiment, ...] = field(default=())
    seed: int = 0

    @property
    def verdict(self) -> Verdict:
        """Verdict on the robot: that of its least certain axis."""
        order = list(Verdict)
        return max((one.verdict for one in self.axes.values()), key=order.index, default=order[0])

    @property
    def places(self) -> tuple[LocatedGap, ...]:
        """Axes and taps whose gap is above the floor beyond doubt, largest first."""
        found = [place for one in self.axes.values() for place in one.places if place.significant]
        return tuple(sorted(found, key=lambda place: -place.excess))

    @property
    def causes(self) -> tuple[Cause, ...]:
        """All causes, ordered by the gap that each closes, in floors of its tap."""
        return tuple(cause for one in self.axes.values() for cause in one.causes)

    @property
    def fitted(self) -> tuple[AxisEffect, ...]:
        """The effects that make the model the corrected one."""
        return tuple(effect for one in self.axes.values() for effect in one.fitted)
