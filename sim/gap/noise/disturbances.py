"""Disturbances that commands do not cause: outliers, lost steps, coarse steps, noise, vibration.

They cannot be predicted sample by sample, so they are not fitted like other effects. They are found
by their traces and removed before the fits: outliers are left out, jumps are taken back, vibration
becomes a nuisance signal of each record, and noise raises the floor.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import AxisProperties, EffectFamily, EffectSignature
from rotemina.sim.gap.fit import (
    Evidence,
    Observation,
    Signals,
    catalogue,
    cell_of,
    fit,
    floor_beyond,
    shown_as,
)
from rotemina.sim.gap.noise.lost_step_jumps import jumps as jumps_in
from rotemina.sim.gap.noise.reading_increment import coarse_step, stands_on
from rotemina.sim.gap.noise.spectral_noise import common_level, noise_level, slow_level
from rotemina.sim.gap.noise.spikes import excursions
from rotemina.sim.gap.noise.vibration_lines import tone_signals, tones
from rotemina.sim.messages import (
    FieldList,
    Message,
    NumberText,
    format_rounded,
    message,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, StepperAxis
from rotemina.sim.units import format_exact

_MORE_NOISE = 1.3  # floors from which noise is more than declared
_SETTLED_S = 0.3  # after which a held axis rests
_AROUND_A_JUMP_S = 0.08
_LOOSE = 0.85  # of the gap's power, that a play closes where no steps were lost
_PLAY_STEPS = 4
_JUMPING = 0.6  # of the gap's power in all records, that lost steps must close
_SHAKEN = 0.1  # of its range, that another axis' going through all of its own may shake an axis
_REST_ROWS = 100
_SURE = 5  # spikes of a sensor, from which others are some whatever the command did
_SAME_TONE = 0.02  # relative difference of frequencies that are one


@dataclass(frozen=True, slots=True)
class Disturbance:
    """A disturbance that only chance or time determines.

    ``power`` is its contribution to the mean square of the gap at the tap, in declared floors;
    ``note`` a complete sentence; ``step`` the step of a coarse reading, SI.
    """

    sign: EffectSignature
    tap: Tap
    power: float
    note: Message
    step: float | None = None

    @property
    def effect(self) -> str | None:
        """The effect that shows so; None if none is installed."""
        return shown_as(self.sign)


def set_aside(
    evidence: Evidence,
    explained: Sequence[AxisEffect] = (),
    *,
    jumps: bool = True,
    cells: bool = True,
) -> tuple[Evidence, tuple[Disturbance, ...]]:
    """Return evidence without disturbances, and the disturbances.

    The search uses a model with the ``explained`` effects; sudden ``jumps`` may stay, and coarse
    steps may count as noise instead of ``cells``.
    """
    robot = evidence.robot
    if explained:
        evidence = evidence.with_model(replace(robot, effects=(*robot.effects, *explained)))
    found: list[Disturbance] = []
    floors = partial(_with_true_floors, cells=cells)
    steps = (_without_jumps, _without_tones, _without_excursions, floors)
    for step in steps if jumps else steps[1:]:
        evidence, own = step(evidence)
        found += own
    return evidence.with_model(robot) if explained else evidence, tuple(found)


def _without_jumps(evidence: Evidence) -> tuple[Evidence, list[Disturbance]]:
    axis = evidence.robot.axes[evidence.axis]
    if not isinstance(axis, StepperAxis):
        return evidence, []
    quantum = 4.0 * AxisProperties.of(axis).full_step
    observations, count = [], 0
    power: dict[Tap, float] = {}
    whole = zip(evidence.observations, evidence.gaps(), evidence.response(), strict=True)
    for observation, gaps, answer in whole:
        tap = next(iter(gaps), None)
        found = [] if tap is None else _jumps(observation, gaps, tap, quantum)
        if found and tap is not None:
            before, time_s = gaps[tap], observation.record.time_s
            taken_back = _taken_back(observation, found)
            after = evidence.with_observations([taken_back]).gaps()[0][tap]
            left = float(np.sum(after**2))
            if left < _late_left(before, answer[tap], time_s):
                observation = taken_back
                power[tap] = power.get(tap, 0.0) + float(np.sum(before**2)) - left
                count += len(found)
        observations.append(observation)
    gap = {tap: _power(evidence, evidence.residual(), tap) for tap in power}
    if all(total < _JUMPING * gap[tap] * _rows(evidence, tap) for tap, total in power.items()):
        return evidence, []  # a play that is used up, or what else is there in all records
    if power and _is_loose(evidence):
        return evidence, []
    note = message(
        "gap", "{n} sudden jumps by whole multiples of four full steps were removed."
    ).fill(n=str(count))
    return evidence.with_observations(observations), [
        Disturbance(EffectSignature.JUMPS, tap, total / _rows(evidence, tap), note)
        for tap, total in power.items()
    ]


def _is_loose(evidence: Evidence) -> bool:
    """Tell whether one play does at every reversal what jumps would do at some.

    So jumps an axis that is loose, and one that its drive bends until it breaks loose.
    """
    before = evidence.residual()
    part = evidence.parts[0]
    width = 2.0 * float(np.std(before[part.rows])) * evidence.floor(part.tap)
    left = min(
        (fit(evidence, [play], most_steps=_PLAY_STEPS).cost for play in _plays(evidence, width)),
        default=np.inf,
    )
    return left < (1.0 - _LOOSE) * float(np.mean(before**2))


def _plays(evidence: Evidence, width: float) -> Iterator[AxisEffect]:
    """Express losses at a reversal that depend only on a width in their usual form."""
    for effect in catalogue():
        form = effect.formulations[0]
        by_width = [parameter.name for parameter in form.parameters] == ["width"]
        if effect.kinship.family is EffectFamily.LOST_MOTION and by_width:
            yield AxisEffect(
                axis=evidence.axis,
                id=effect.id,
                formulation=form.name,
                parameters={"width": width},
            )


def _late_left(gap: FloatArray, answer: FloatArray, time_s: FloatArray) -> float:
    """Return the sum of squares of a gap (n,) that a reading which comes late would leave.

    At an even pace it is off by a constant, as after a jump.
    """
    pace = np.gradient(answer, time_s)
    pace = pace - pace.mean()
    late = float(pace @ gap) / max(float(pace @ pace), 1e-300)
    return float(np.sum((gap - late * pace) ** 2))


def _jumps(
    observation: Observation, gaps: Signals, tap: Tap, quantum: float
) -> list[tuple[int, float]]:
    """Return rows and sizes, SI, of the jumps in a record."""
    floor = observation.floor[tap]
    found = jumps_in(observation.record.time_s, gaps[tap], quantum / floor)
    return [(row, size * floor) for row, size in found]


def _taken_back(observation: Observation, found: Sequence[tuple[int, float]]) -> Observation:
    time_s = observation.record.time_s
    offset = np.zeros(len(time_s))
    kept = np.ones(len(time_s), dtype=np.bool_)
    for row, size in found:
        offset[row:] += size
        kept &= np.abs(time_s - time_s[row]) > _AROUND_A_JUMP_S
    moved = {tap: s if tap is Tap.U else s - offset for tap, s in observation.real.items()}
    masks = dict(observation.kept)
    for tap in moved:
        if tap is not Tap.U:
            masks[tap] = _kept(observation, tap) & kept
    return replace(observation, real=moved, kept=masks)


def _without_excursions(evidence: Evidence) -> tuple[Evidence, list[Disturbance]]:
    gaps = evidence.gaps()
    found = _excursions(evidence, gaps, sure=False)
    if sum(_runs_of(one) for one in found.values()) >= _SURE:
        found = _excursions(evidence, gaps, sure=True)
    observations, power, count = list(evidence.observations), 0.0, 0
    for number, rows in found.items():
        observation, gap = observations[number], _sensor_gap(observations[number], gaps[number])
        around = float(np.median(gap))
        power += float(np.sum((gap[rows] - around) ** 2))
        count += _runs_of(rows)
        masks = {**observation.kept, Tap.MEAS: _kept(observation, Tap.MEAS) & ~rows}
        observations[number] = replace(observation, kept=masks)
    if not count:
        return evidence, []
    note = message("gap", "{n} spikes or dropouts of the sensor were left out.").fill(n=str(count))
    share = power / _rows(evidence, Tap.MEAS)
    return evidence.with_observations(observations), [
        Disturbance(EffectSignature.SPIKES, Tap.MEAS, share, note)
    ]


def _excursions(evidence: Evidence, gaps: Sequence[Signals], *, sure: bool) -> dict[int, BoolArray]:
    """Return the rows (n,) of the records that are outliers of the sensor."""
    found: dict[int, BoolArray] = {}
    for number, (observation, gap) in enumerate(zip(evidence.observations, gaps, strict=True)):
        if Tap.MEAS in gap:
            floor = observation.floor[Tap.MEAS]
            rows = excursions(
                observation.record.time_s,
                _sensor_gap(observation, gap),
                observation.real[Tap.MEAS] / floor,
                _commanded_change(evidence, observation.record) / floor,
                sure=sure or Tap.REF in observation.real,
            )
            found[number] = rows & _kept(observation, Tap.MEAS)
    return {number: rows for number, rows in found.items() if rows.any()}


def _runs_of(rows: BoolArray) -> int:
    return int(np.sum(np.diff(rows.astype(np.int8), prepend=0) == 1))


def _commanded_change(evidence: Evidence, record: Record) -> FloatArray:
    """Return how far (n,) commands went in a row: the axis' own, and others' as they shake it."""
    change = np.zeros(len(record.time_s))
    span = AxisProperties.of(evidence.robot.axes[evidence.axis]).span
    for axis in record.axes:
        if record.has(axis, Tap.CMD):
            command = record.signal(axis, Tap.CMD)
            share = 1.0 if axis == evidence.axis else _SHAKEN
            size = share * span / AxisProperties.of(evidence.robot.axes[axis]).span
            change = np.maximum(change, size * np.abs(np.diff(command, prepend=command[0])))
    return change


def _without_tones(evidence: Evidence) -> tuple[Evidence, list[Disturbance]]:
    rests = any(resting(one.record).sum() >= _REST_ROWS for one in evidence.observations)
    if len(evidence.observations) < 2 and not rests:
        return evidence, []  # any line may be one of the command's
    by_record: list[list[float]] = []
    gaps = evidence.gaps()
    taps = [next((tap for tap in (Tap.REF, Tap.MEAS) if tap in gap), None) for gap in gaps]
    for observation, gap, tap in zip(evidence.observations, gaps, taps, strict=True):
        if tap is None:
            return evidence, []
        kept = _kept(observation, tap)
        record = observation.record
        still = resting(record) & kept
        left = np.where(kept, gap[tap], 0.0)
        by_record.append(tones(record.time_s, left, still))
    shared = _shared(by_record)
    if not shared:
        return evidence, []
    observations = []
    for number, observation in enumerate(evidence.observations):
        own = [lines[number] for lines in shared]
        signals = tone_signals(observation.record.time_s, own)
        observations.append(replace(observation, nuisance=signals))
    quiet = evidence.with_observations(observations)
    before, after = evidence.residual(), quiet.residual()
    listed = FieldList(
        tuple(NumberText(f"{format_rounded(float(np.mean(lines)))} Hz") for lines in shared)
    )
    note = message("gap", "A vibration of {frequencies}, independent of the axis, was removed.")
    note = note.fill(frequencies=listed)
    return quiet, [
        Disturbance(EffectSignature.TONES, tap, power, note)
        for tap in dict.fromkeys(one for one in taps if one is not None)
        for power in (_power(evidence, before, tap) - _power(evidence, after, tap),)
    ]


def _shared(by_record: Sequence[Sequence[float]]) -> list[list[float]]:
    """Return lines that all records have, each with its frequency in every record."""
    shared = []
    for line in by_record[0] if by_record else []:
        alike = [min(own, key=lambda other: abs(other - line), default=0.0) for own in by_record]
        if all(abs(other - line) <= max(_SAME_TONE * line, 0.3) for other in alike):
            shared.append(alike)
    return shared


def _with_true_floors(evidence: Evidence, *, cells: bool) -> tuple[Evidence, list[Disturbance]]:
    """Raise the floor of a sensor that is coarser or noisier than declared."""
    gaps, answers = evidence.gaps(), evidence.response()
    readings, levels, gaps_kept, paces = [], [], [], []
    for observation, gap, answer in zip(evidence.observations, gaps, answers, strict=True):
        if Tap.MEAS not in gap:
            continue
        kept = _kept(observation, Tap.MEAS)
        readings.append(_as_expected(evidence, observation, answer, kept))
        own = _sensor_gap(observation, gap)[kept]
        gaps_kept.append(own)
        paces.append(np.abs(np.gradient(answer[Tap.MEAS], observation.record.time_s))[kept])
        levels.append(noise_level(own))
    if not levels:
        return evidence, []
    floor = evidence.floor(Tap.MEAS)
    step = _coarse(readings)
    level = min(common_level(levels), slow_level(gaps_kept, paces))
    if step is not None:
        power = (step / floor) ** 2 / 12.0
        unit = evidence.observations[0].record.units[evidence.axis]
        note = message("gap", "The sensor reads in steps of {step}.")
        note = note.fill(step=format_exact(step, unit))
        # At rest an error of up to half a step stays as it is, which no mean over errors tells.
        raised = _raised(evidence, float(np.sqrt(1.0 + 3.0 * power)))
        seen = _by_cells(evidence, raised, answers, step) if cells else raised
        return seen, [Disturbance(EffectSignature.STEPS, Tap.MEAS, power, note, step)]
    if level > _MORE_NOISE:
        note = message("gap", "The sensor is {times} times as noisy as declared.")
        note = note.fill(times=format_rounded(level, 3))
        return _raised(evidence, level), [
            Disturbance(EffectSignature.NOISE, Tap.MEAS, level**2 - 1.0, note)
        ]
    return evidence, []


def _by_cells(
    fine: Evidence, raised: Evidence, answers: Sequence[Signals], step: float
) -> Evidence:
    """Return evidence with steps as cells; raise the floor for records with few edges."""
    observations = []
    for own, coarse, answer in zip(fine.observations, raised.observations, answers, strict=True):
        floor, cell = own.floor.get(Tap.MEAS), None
        if floor is not None:
            cell = cell_of(own.real[Tap.MEAS], answer[Tap.MEAS], step, floor)
        if floor is not None and cell is not None:
            over = {**own.floor, Tap.MEAS: floor_beyond(floor, cell)}
            coarse = replace(own, floor=over, cell={Tap.MEAS: cell})
        observations.append(coarse)
    return fine.with_observations(observations)


def _as_expected(
    evidence: Evidence, observation: Observation, answer: Signals, kept: BoolArray
) -> tuple[FloatArray, FloatArray, float]:
    """Return the reading (n,), the expected reading of the declared sensor, and its finest step.

    A recorded reference gives the expected reading: it is the true position of the axis.
    """
    sensor = evidence.robot.axes[evidence.axis].sensor
    reading = observation.real[Tap.MEAS][kept]
    where = observation.real.get(Tap.REF, answer[Tap.MEAS])[kept]
    expected = _noisy(where, 0.0 if sensor is None else sensor.noise_rms)
    finest = observation.floor[Tap.MEAS]
    if sensor is not None and sensor.resolution:
        finest = max(finest, sensor.resolution)
        expected = np.rint(expected / sensor.resolution) * sensor.resolution
    return reading, expected, finest


def _coarse(readings: Sequence[tuple[FloatArray, FloatArray, float]]) -> float | None:
    """Return the step of a sensor in most records; None if it is as fine as declared.

    One record that shows it by repeated positions suffices if all records lie on it.
    """
    told = [step for one in readings if (step := coarse_step(*one)) is not None]
    if not told:
        return None
    step = float(np.median(told))
    if len(told) > len(readings) / 2 or all(stands_on(*one, step) for one in readings):
        return step
    return None


def _noisy(reading: FloatArray, noise_rms: float) -> FloatArray:
    """Return a possible reading of a sensor with the declared noise."""
    rng = np.random.default_rng(0)  # any noise will do, but always the same
    return np.asarray(reading + noise_rms * rng.standard_normal(len(reading)))


def _raised(evidence: Evidence, times: float) -> Evidence:
    return evidence.with_observations(
        [
            replace(one, floor={**one.floor, Tap.MEAS: one.floor[Tap.MEAS] * times})
            if Tap.MEAS in one.floor
            else one
            for one in evidence.observations
        ]
    )


def _sensor_gap(observation: Observation, gaps: Signals) -> FloatArray:
    """Return the deviation (n,) of the sensor from the reference, or from the model; in floors.

    Errors of the model's own sensor are not part of it.
    """
    if Tap.REF not in observation.real:
        return gaps[Tap.MEAS]
    apart = gaps[Tap.MEAS] - gaps[Tap.REF] * (
        observation.floor[Tap.REF] / observation.floor[Tap.MEAS]
    )
    return np.asarray(apart - np.median(apart))


def _kept(observation: Observation, tap: Tap) -> BoolArray:
    kept = observation.kept.get(tap)
    return np.ones(len(observation.real[tap]), dtype=np.bool_) if kept is None else kept


def resting(record: Record) -> BoolArray:
    """Return where (n,) every axis has been held for a while."""
    rows = len(record.time_s)
    last = np.full(rows, -np.inf)
    for axis in record.axes:
        if record.has(axis, Tap.CMD):
            command = record.signal(axis, Tap.CMD)
            moved = np.where(np.diff(command, prepend=command[0]) != 0.0, np.arange(rows), -1)
            latest = np.maximum.accumulate(moved)
            last = np.maximum(last, np.where(latest >= 0, record.time_s[latest], -np.inf))
    return np.asarray(record.time_s - last > _SETTLED_S)


def _power(evidence: Evidence, residual: FloatArray, tap: Tap) -> float:
    rows = [part.rows for part in evidence.parts if part.tap is tap]
    return float(np.mean(np.concatenate([residual[own] for own in rows]) ** 2))


def _rows(evidence: Evidence, tap: Tap) -> int:
    return sum(len(o.real[tap]) for o in evidence.observations if tap in o.real)


def by_effect(found: Sequence[Disturbance]) -> Iterator[Disturbance]:
    """Give one disturbance of each effect, at the tap where it shows first."""
    seen: Mapping[EffectSignature, Disturbance] = {one.sign: one for one in reversed(found)}
    yield from seen.values()


def power_by_tap(evidence: Evidence, found: Sequence[Disturbance]) -> dict[Tap, float]:
    """Return what disturbances add to the mean square at each tap, in declared floors.

    What shows at the reference is a true motion, which the sensor sees as well, in floors of its
    own.
    """
    power: dict[Tap, float] = {}
    for one in found:
        power[one.tap] = power.get(one.tap, 0.0) + one.power
        if one.tap is Tap.REF and any(Tap.MEAS in own.floor for own in evidence.observations):
            share = (evidence.floor(Tap.REF) / evidence.floor(Tap.MEAS)) ** 2
            power[Tap.MEAS] = power.get(Tap.MEAS, 0.0) + share * one.power
    return power
