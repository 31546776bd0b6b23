"""The diagnosis of the sim-to-real gap, from records to verdict.

The records are checked (``intake``) and the gap is located (``location``). Axis by axis, as what
one axis does may show on another (:mod:`~rotemina.sim.gap.examination_order`), disturbances are
set aside (``noise``), effects are fitted (``fit``) and compared (``compare``): that is
:func:`~rotemina.sim.gap.examination.examine`. :mod:`~rotemina.sim.gap.conclusions` says what
follows from it, ``experiment`` what to record next, ``output`` writes it down.
"""

import hashlib
import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from threadpoolctl import threadpool_limits

from rotemina.sim.gap.compare.diagnosis_progress import Account, Listener, Progress, unheard
from rotemina.sim.gap.conclusions import concluded
from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Offset, Verdict
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.examination import Examination, examine
from rotemina.sim.gap.examination_order import examination_order
from rotemina.sim.gap.experiment.next_experiment import experiments
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import NUMERICAL
from rotemina.sim.gap.intake.cautions import Caution, remarks
from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.gap.intake.time_leaps import pieces
from rotemina.sim.gap.location.located_gap import LocatedGap, locate
from rotemina.sim.gap.output.constant_offsets import offsets
from rotemina.sim.gap.thresholds import SOME
from rotemina.sim.messages import AxisName, joined, message
from rotemina.sim.plant.coupled_groups import coupled_axes
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect, Robot

_LOG = logging.getLogger(__name__)
_LEAST_LEFT = 0.06  # of an axis' gap, that other axes' causes must leave for it to have its own
_SHAKES = 10.0  # times the power of a gap, that a coupled axis' one has to be the reason of it
_LEAST_BEYOND_THE_SENSOR = 2.5  # floors of a finer reference, that a sensor does not see
_LEAST_GAP = 1.45  # floors below which a gap is no matter: an encoder at rest may be off so far


def diagnose(
    robot: Robot,
    records: Sequence[Record],
    *,
    seed: int = 0,
    jobs: int = 1,
    listener: Listener = unheard,
    cautions: Sequence[Caution] | None = None,
) -> Diagnosis:
    """Find where the gap between a robot's model and its records lies, and what causes it.

    Parameters
    ----------
    robot : Robot
        The model, with the effects that it already has.
    records : sequence of Record
        They may differ in rate, length, axes and taps. Their order changes nothing. One in which
        time leaps is taken in pieces.
    seed : int
        Of the draws from which intervals come.
    jobs : int
        How many candidates are tried at a time.
    listener : Listener
        Is told of every step; what it raises ends the diagnosis.
    cautions : sequence of Caution, optional
        What :func:`~rotemina.sim.gap.intake.record_checks.check` said of these records; None:
        check them here.

    Raises
    ------
    GapError, PlantError, EffectError
        If the records cannot be diagnosed.
    """
    if cautions is None:
        cautions = check(robot, records)
    whole = [one.record for one in pieces(records)]
    run = _Run(robot, _in_order(whole), np.random.default_rng(seed), jobs, listener)
    # Threads of the linear algebra library only get in the way of matrices as narrow as these.
    with threadpool_limits(limits=1):
        axes = run.diagnosed()
        constants = run.offsets(axes)
    cautioned = {
        name: replace(
            one, offsets=constants[name], remarks=(*one.remarks, *remarks(cautions, name))
        )
        for name, one in axes.items()
    }
    suggested = [one for found in run.examined.values() for one in experiments(robot, found)]
    return Diagnosis(robot, cautioned, tuple(suggested), seed)


def _in_order(records: Sequence[Record]) -> list[Record]:
    """Return records in an order that depends only on their contents."""

    def content(record: Record) -> str:
        digest = hashlib.sha256(record.time_s.tobytes())
        for axis in sorted(record.axes):
            for tap in Tap:
                if record.has(axis, tap):
                    digest.update(f"{axis}.{tap}".encode())
                    digest.update(record.signal(axis, tap).tobytes())
        return digest.hexdigest()

    return sorted(records, key=content)


@dataclass
class _Run:
    """A diagnosis on its way."""

    robot: Robot
    records: Sequence[Record]
    rng: np.random.Generator
    jobs: int
    listener: Listener
    examined: dict[str, Examination] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)

    def diagnosed(self) -> dict[str, AxisDiagnosis]:
        """Return what can be said of each axis that was measured, in the robot's order."""
        self._tell("where", None, None, 0.0)
        evidences = self._evidences()
        places = {name: locate(one, self.rng) for name, one in evidences.items()}
        gaps = [name for name in evidences if _has_gap(places[name])]
        gaps.sort(key=lambda name: -max(place.excess for place in places[name]))
        for number, name in enumerate(examination_order(evidences, gaps)):
            self._examine(name, evidences[name], 0.9 * number / len(gaps), 0.9 / len(gaps))
        told = {name: self._conclusion(name, places[name], name in gaps) for name in evidences}
        return {name: self._shaken(one, told) for name, one in told.items()}

    def offsets(self, axes: Mapping[str, AxisDiagnosis]) -> dict[str, dict[Tap, Offset | None]]:
        """Return the constants of the corrected model that all records agree on."""
        corrected = _with(self.robot, [effect for one in axes.values() for effect in one.fitted])
        found: dict[str, dict[Tap, Offset | None]] = {}
        for name in axes:
            try:
                found[name] = offsets(self._bare(name).with_model(corrected))
            except PlantError:  # no steady state with all axes' effects together
                found[name] = {}
        return found

    def _evidences(self) -> dict[str, Evidence]:
        found: dict[str, Evidence] = {}
        refusals = []
        for name in self.robot.axes:
            if any(name in record.axes for record in self.records):
                try:
                    found[name] = Evidence.of(self.robot, name, self.records)
                except GapError as error:
                    refusals.append(str(error))
        if not found:
            raise GapError(
                joined(refusals, "; ")
                if refusals
                else message("gap", "the records name no axis of the robot")
            )
        return found

    def _examine(self, name: str, evidence: Evidence, begin: float, share: float) -> None:
        context = [e for other, one in self.examined.items() if other != name for e in one.fitted]
        evidence = evidence.with_model(_with(self.robot, context))
        account = Account(name, self.listener, begin, share)
        evidence = replace(evidence, heartbeat=account.heartbeat)
        before = float(np.mean(self._bare(name).residual() ** 2))
        now = float(np.mean(evidence.residual() ** 2))
        if context and now - 1.0 < _LEAST_LEFT * (before - 1.0):
            return
        try:
            examined = examine(evidence, account, jobs=self.jobs)
        except NUMERICAL as error:
            _LOG.warning("axis %s: its examination failed: %s", name, error)
            self.failed[name] = str(error)
            return
        leaked = context and now - 1.0 < SOME * (before - 1.0)
        if not (leaked and examined.verdict is Verdict.UNKNOWN):
            self.examined[name] = examined

    def _bare(self, name: str) -> Evidence:
        return Evidence.of(self.robot, name, self.records)

    def _conclusion(
        self, name: str, places: tuple[LocatedGap, ...], has_gap: bool
    ) -> AxisDiagnosis:
        if name in self.examined:
            return concluded(self.examined[name], places, self.rng)
        if name in self.failed:
            why = message("gap", "The computation failed, so no cause can be found: {error}.")
            said = (why.fill(error=self.failed[name]),)
            return AxisDiagnosis(name, Verdict.UNKNOWN, places, remarks=said)
        elsewhere = message("gap", "Its gap comes from the causes on other axes.")
        return AxisDiagnosis(name, Verdict.NONE, places, remarks=(elsewhere,) if has_gap else ())

    def _shaken(self, one: AxisDiagnosis, told: Mapping[str, AxisDiagnosis]) -> AxisDiagnosis:
        """Return the result for an axis shaken by an unexplained axis through a coupling."""
        if one.verdict not in (Verdict.UNKNOWN, Verdict.INSUFFICIENT):
            return one
        for group in coupled_axes(self.robot):
            for other in group - {one.axis} if one.axis in group else ():
                if (
                    other in told
                    and told[other].verdict in (Verdict.UNKNOWN, Verdict.INSUFFICIENT)
                    and _excess(told[other]) > _SHAKES * _excess(one)
                ):
                    said = message(
                        "gap",
                        "It is coupled to axis {axis}, whose gap is larger and not explained.",
                    ).fill(axis=AxisName(other))
                    return replace(
                        one, verdict=Verdict.NONE, causes=(), remarks=(said, *one.remarks)
                    )
        return one

    def _tell(self, stage: str, axis: str | None, candidate: str | None, share: float) -> None:
        self.listener(Progress(stage, axis, candidate, share))


def _excess(one: AxisDiagnosis) -> float:
    return max((place.excess for place in one.places), default=0.0)


def _has_gap(places: Sequence[LocatedGap]) -> bool:
    """Tell whether a gap matters: at a reference finer than the sensor it must be clear."""
    by_sensor = any(place.tap is Tap.MEAS for place in places)
    least = {Tap.REF: _LEAST_BEYOND_THE_SENSOR} if by_sensor else {}
    return any(
        (place.significant or place.sudden)
        and place.gap_rms > least.get(place.tap, _LEAST_GAP) * place.noise_floor
        for place in places
    )


def _with(robot: Robot, effects: Sequence[AxisEffect]) -> Robot:
    return replace(robot, effects=(*robot.effects, *effects))
