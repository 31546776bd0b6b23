"""Diagnosis of the sim-to-real gap, from records to verdict.

1. ``intake`` checks the records.
2. ``location`` locates the gap.
3. :func:`~rotemina.sim.gap.examination.examine` treats one axis after the other: it sets
   disturbances aside (``noise``), fits effects (``fit``) and compares them (``compare``). An axis
   can disturb another one, so ``examination_order`` determines the order.
4. :mod:`~rotemina.sim.gap.pipeline.conclusions` turns the findings into causes and figures.
5. ``experiment`` suggests what to record next.
6. ``output`` writes the result.
"""

import hashlib
import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from threadpoolctl import threadpool_limits

from rotemina.sim.errors import GapError, PlantError
from rotemina.sim.gap.examination import AxisExamination, examine, order_axes
from rotemina.sim.gap.experiment import suggest_experiments
from rotemina.sim.gap.fit import NUMERICAL, Evidence
from rotemina.sim.gap.intake import RecordCaution, check_records, collect_remarks, split_at_leaps
from rotemina.sim.gap.limits import MIN_SHARE_TO_NAME
from rotemina.sim.gap.location import LocatedGap, locate_gap
from rotemina.sim.gap.output import estimate_offsets
from rotemina.sim.gap.pipeline.conclusions import draw_conclusions
from rotemina.sim.gap.result import (
    Account,
    AxisDiagnosis,
    Diagnosis,
    FailedStep,
    GapVerdict,
    Listener,
    ModelOffset,
    Progress,
    unheard,
)
from rotemina.sim.messages import (
    AxisName,
    Message,
    join_messages,
    message,
)
from rotemina.sim.plant import find_coupled_axes
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, Robot

_LOG = logging.getLogger(__name__)
# A gap belongs to its axis only if causes on other axes leave at least this fraction of its power.
_MIN_OWN_GAP_RATIO = 0.06
# A gap is attributed to a coupled axis whose gap has more than this many times the power.
_MIN_COUPLED_POWER_RATIO = 10.0
# A gap at a reference finer than the sensor counts only above this many floors.
_MIN_REFERENCE_GAP_FLOORS = 2.5
# A gap counts only above this many floors, because an encoder at rest may be off by as much.
_MIN_GAP_FLOORS = 1.45


def diagnose(
    robot: Robot,
    records: Sequence[Record],
    *,
    seed: int = 0,
    jobs: int = 1,
    listener: Listener = unheard,
    cautions: Sequence[RecordCaution] | None = None,
) -> Diagnosis:
    """Find where the gap between a robot's model and its records lies, and what causes it.

    Parameters
    ----------
    robot : Robot
        The model, with the effects that it already contains.
    records : sequence of Record
        They may differ in rate, length, axes and taps. Their order does not matter. A record with
        time leaps is split into pieces.
    seed : int
        Random seed of the resampling that gives the intervals.
    jobs : int
        Number of candidates that are tried at the same time.
    listener : Listener
        Called after every step. An exception it raises ends the diagnosis.
    cautions : sequence of RecordCaution, optional
        Result of :func:`~rotemina.sim.gap.intake.check_records` for these records. If
        None, the records are checked here.

    Raises
    ------
    GapError, PlantError, EffectError
        If the records cannot be diagnosed.
    """
    if cautions is None:
        cautions = check_records(robot, records)
    record_pieces = [piece.record for piece in split_at_leaps(records)]
    run = _DiagnosisRun(
        robot, _sort_by_content(record_pieces), np.random.default_rng(seed), jobs, listener
    )
    # The matrices are so narrow that threads of the linear algebra library only cost time.
    with threadpool_limits(limits=1):
        axes = run.diagnose_axes()
        offsets = run.find_offsets(axes)
    completed = {
        name: replace(
            axis, offsets=offsets[name], remarks=(*axis.remarks, *collect_remarks(cautions, name))
        )
        for name, axis in axes.items()
    }
    suggestions = [
        experiment
        for examination in run.examinations.values()
        for experiment in suggest_experiments(robot, examination)
    ]
    return Diagnosis(robot, completed, tuple(suggestions), seed, tuple(run.failed))


def _sort_by_content(records: Sequence[Record]) -> list[Record]:
    def compute_digest(record: Record) -> str:
        digest = hashlib.sha256(record.time_s.tobytes())
        for axis in sorted(record.axes):
            for tap in Tap:
                if record.has(axis, tap):
                    digest.update(f"{axis}.{tap}".encode())
                    digest.update(record.signal(axis, tap).tobytes())
        return digest.hexdigest()

    return sorted(records, key=compute_digest)


@dataclass
class _DiagnosisRun:
    robot: Robot
    records: Sequence[Record]
    rng: np.random.Generator
    jobs: int
    listener: Listener
    examinations: dict[str, AxisExamination] = field(default_factory=dict)
    failed: list[FailedStep] = field(default_factory=list)

    def diagnose_axes(self) -> dict[str, AxisDiagnosis]:
        """Return the result for each measured axis, in the order of the robot."""
        self._report_progress("where", None, None, 0.0)
        evidences = self._gather_evidence()
        places = {name: locate_gap(evidence, self.rng) for name, evidence in evidences.items()}
        axes_with_gap = [name for name in evidences if _has_gap(places[name])]
        axes_with_gap.sort(key=lambda name: -max(place.excess for place in places[name]))
        for number, name in enumerate(order_axes(evidences, axes_with_gap)):
            self._examine(
                name, evidences[name], 0.9 * number / len(axes_with_gap), 0.9 / len(axes_with_gap)
            )
        results = {
            name: self._conclude(name, places[name], name in axes_with_gap) for name in evidences
        }
        return {
            name: self._attribute_to_coupling(result, results) for name, result in results.items()
        }

    def find_offsets(
        self, axes: Mapping[str, AxisDiagnosis]
    ) -> dict[str, dict[Tap, ModelOffset | None]]:
        """Return the constant offset of each axis and tap; None if the records disagree."""
        corrected = _with_effects(
            self.robot, [effect for axis in axes.values() for effect in axis.fitted]
        )
        offsets: dict[str, dict[Tap, ModelOffset | None]] = {}
        for name in axes:
            try:
                offsets[name] = estimate_offsets(
                    self._gather_bare_evidence(name).with_model(corrected)
                )
            # The effects of all axes together may have no steady state.
            except PlantError:
                offsets[name] = {}
        return offsets

    def _gather_evidence(self) -> dict[str, Evidence]:
        evidences: dict[str, Evidence] = {}
        error_texts = []
        for name in self.robot.axes:
            if any(name in record.axes for record in self.records):
                try:
                    evidences[name] = Evidence.of(self.robot, name, self.records)
                except GapError as error:
                    error_texts.append(str(error))
        if not evidences:
            raise GapError(
                join_messages(error_texts, "; ")
                if error_texts
                else message("gap", "the records contain no axis of the robot")
            )
        return evidences

    def _examine(self, name: str, evidence: Evidence, begin_progress: float, share: float) -> None:
        effects_on_other_axes = [
            effect
            for other, examination in self.examinations.items()
            if other != name
            for effect in examination.fitted
        ]
        evidence = evidence.with_model(_with_effects(self.robot, effects_on_other_axes))
        account = Account(name, self.listener, begin_progress, share)
        evidence = replace(evidence, heartbeat=account.heartbeat, note_failure=account.note_failure)
        original_power = float(np.mean(self._gather_bare_evidence(name).residual() ** 2))
        present_power = float(np.mean(evidence.residual() ** 2))
        # The causes on axes that were examined earlier already explain the gap of this axis.
        if effects_on_other_axes and present_power - 1.0 < _MIN_OWN_GAP_RATIO * (
            original_power - 1.0
        ):
            return
        try:
            new_examination = examine(evidence, account, jobs=self.jobs)
        except NUMERICAL as error:
            _LOG.exception("axis %s: its examination failed", name)
            account.note_failure((), error)
            return
        finally:
            self.failed += account.failed
        # If other axes explain most of the gap, an unexplained remainder is ignored.
        is_mostly_explained = effects_on_other_axes and present_power - 1.0 < MIN_SHARE_TO_NAME * (
            original_power - 1.0
        )
        if not (is_mostly_explained and new_examination.verdict is GapVerdict.UNKNOWN):
            self.examinations[name] = new_examination

    def _gather_bare_evidence(self, name: str) -> Evidence:
        return Evidence.of(self.robot, name, self.records)

    def _conclude(self, name: str, places: tuple[LocatedGap, ...], has_gap: bool) -> AxisDiagnosis:
        if name in self.examinations:
            return draw_conclusions(self.examinations[name], places, self.rng)
        for step in self.failed:
            if step.axis == name and not step.effects:
                return AxisDiagnosis(
                    name, GapVerdict.FAILED, places, remarks=(_describe_failure(step),)
                )
        text = message("gap", "Its gap comes from the causes on other axes.")
        return AxisDiagnosis(name, GapVerdict.NONE, places, remarks=(text,) if has_gap else ())

    def _attribute_to_coupling(
        self, axis: AxisDiagnosis, axes: Mapping[str, AxisDiagnosis]
    ) -> AxisDiagnosis:
        """Return the result for an axis, corrected if a coupled axis causes its gap.

        An unexplained gap is attributed to a coupled axis whose own gap is unexplained and far
        larger.
        """
        if axis.verdict not in (GapVerdict.UNKNOWN, GapVerdict.INSUFFICIENT):
            return axis
        for group in find_coupled_axes(self.robot):
            for other in group - {axis.axis} if axis.axis in group else ():
                if (
                    other in axes
                    and axes[other].verdict in (GapVerdict.UNKNOWN, GapVerdict.INSUFFICIENT)
                    and _find_largest_excess(axes[other])
                    > _MIN_COUPLED_POWER_RATIO * _find_largest_excess(axis)
                ):
                    text = message(
                        "gap",
                        "It is coupled to axis {axis}, whose gap is larger and not explained.",
                    ).fill(axis=AxisName(other))
                    return replace(
                        axis, verdict=GapVerdict.NONE, causes=(), remarks=(text, *axis.remarks)
                    )
        return axis

    def _report_progress(
        self, stage: str, axis: str | None, candidate: str | None, share: float
    ) -> None:
        self.listener(Progress(stage, axis, candidate, share))


def _describe_failure(step: FailedStep) -> Message:
    template = message(
        "gap",
        "The program failed to examine this axis, which says nothing about the machine: {error}.",
    )
    return template.fill(error=step.reason)


def _find_largest_excess(axis: AxisDiagnosis) -> float:
    return max((place.excess for place in axis.places), default=0.0)


def _has_gap(places: Sequence[LocatedGap]) -> bool:
    """Return whether the gap at any tap is large enough to be examined.

    With a sensor reading, a gap at the finer reference must be larger to count.
    """
    has_reading = any(place.tap is Tap.MEAS for place in places)
    min_floors = {Tap.REF: _MIN_REFERENCE_GAP_FLOORS} if has_reading else {}
    return any(
        (place.is_significant or place.is_sudden)
        and place.gap_rms > min_floors.get(place.tap, _MIN_GAP_FLOORS) * place.noise_floor
        for place in places
    )


def _with_effects(robot: Robot, effects: Sequence[AxisEffect]) -> Robot:
    return replace(robot, effects=(*robot.effects, *effects))
