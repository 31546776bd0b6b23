"""Excitation of an axis: the requested motion, and the check of it on the model."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.language import describe_error, format_duration, get_axis_label, translate_message
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.record_query import AnalysisView
from rotemina.sim.errors import ExcitationRequestError, InputError
from rotemina.sim.excitation import (
    Amount,
    Excitation,
    ExcitationKind,
    MultisineExcitation,
    SineExcitation,
    StaircaseExcitation,
    TriangleExcitation,
    excite,
    parse_axis_amount,
)
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.messages import format_rounded, parse_number
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import DryRun, dry_run
from rotemina.sim.units import format_exact

# The commands of two periods are equal if they differ by at most this fraction of the swing.
_MAX_PERIOD_DEVIATION_RATIO = 1e-9


class ExcitationWave(StrEnum):
    """Kind of motion. The value is part of the name of the trajectory."""

    MULTISINE = mark("Multisine")
    SINE = mark("Sine")
    TRIANGLE = mark("Triangle")
    STAIRCASE = mark("Staircase")


# The view in which the record of a motion opens.
WAVE_VIEWS: Mapping[ExcitationWave, AnalysisView] = {
    ExcitationWave.MULTISINE: AnalysisView.FREQUENCY,
    ExcitationWave.SINE: AnalysisView.LOOP,
    ExcitationWave.TRIANGLE: AnalysisView.LOOP,
    ExcitationWave.STAIRCASE: AnalysisView.STEPS,
}


@dataclass(frozen=True, slots=True)
class ExcitationRequest:
    """Request as typed by the operator. An empty text means the default.

    Attributes
    ----------
    axis, wave : the axis, and its kind of motion.
    amplitude : to each side of the middle, such as ``5um``, or ``30%`` of the range.
    frequency : in Hz; for a multisine, the highest frequency.
    time : in s; the duration, or for a staircase, the rest on each level.
    middle : middle of the motion, m or rad, or None for the middle of the range.
    """

    axis: str
    wave: ExcitationWave
    amplitude: str = ""
    frequency: str = ""
    time: str = ""
    middle: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PreparedExcitation:
    """Motion that was computed, and checked on the model.

    Attributes
    ----------
    request : the request for this motion.
    excitation : the trajectory, and the changes that keep it within the limits.
    dry_run : result of the check on the model.
    objection : why the motion must not be played, or "" if it may be played.
    """

    request: ExcitationRequest
    excitation: Excitation
    dry_run: DryRun
    objection: str

    @property
    def name(self) -> str:
        """Name of the motion."""
        return f"{self.request.wave} of {get_axis_label(self.request.axis)}"

    @property
    def digest(self) -> str | None:
        """Digest in the records of this motion, or None if the motion must not be played."""
        checked = self.dry_run.checked
        return None if checked is None or self.objection else checked.digest

    @property
    def description(self) -> str:
        """Text for the screen: range, speed, reductions to the limits, and dry-run result."""
        axis = self.dry_run.axes[self.request.axis]
        low, high = (
            format_exact(end, axis.unit, size=axis.highest) for end in _find_ends(self.dry_run)
        )
        unit = f"{axis.unit}/s"
        motion_text = tr("{low} to {high}, at most {speed}, {time}")
        if axis.bounds.max_speed is not None:
            motion_text = tr("{low} to {high}, at most {speed} of {bound}, {time}")
        motion_text = motion_text.format(
            low=low,
            high=high,
            speed=format_exact(axis.peak_speed, unit),
            bound=format_exact(axis.bounds.max_speed or 0.0, unit),
            time=_format_duration(self.dry_run.duration_s),
        )
        reduction_text = tr("Reduced to the limits: {change}.")
        reductions = (
            reduction_text.format(change=translate_message(adjustment.message))
            for adjustment in self.excitation.adjustments
        )
        verdict = tr("Dry run: within all limits and the bounds of the tip.")
        if self.objection:
            verdict = tr("Not playable: {reason}")
        return "\n".join([motion_text, *reductions, verdict.format(reason=self.objection)])


def prepare_excitation(
    robot: Robot,
    request: ExcitationRequest,
    setpoint_period_s: float,
    zone: KeepOutZone | None = None,
    command: Mapping[str, float] | None = None,
) -> PreparedExcitation:
    """Compute the requested motion, and check it on the model.

    Parameters
    ----------
    robot : Robot
    request : ExcitationRequest
    setpoint_period_s : set-point period of the device that will play it.
    zone : current limits of the tip.
    command : axis -> current command, m or rad, at which the other axes stay.

    Raises
    ------
    InputError
        If a text is not a valid amplitude, frequency or time, or the motion is impossible.
    """
    unit = robot.unit(request.axis) or "m"
    amplitude = (
        parse_axis_amount(request.amplitude, request.axis, unit)
        if request.amplitude.strip()
        else None
    )
    frequency_hz, time_s = (
        _parse_number(mark("frequency"), request.frequency, "Hz"),
        _parse_number(mark("time"), request.time, "s"),
    )
    excitation = excite(robot, {request.axis: _make_kind(request, amplitude, frequency_hz, time_s)})
    result = dry_run(robot, excitation.record, setpoint_period_s=setpoint_period_s)
    objection = next(iter(result.objections), "")
    if not objection:
        objection = _explain_tip_bounds(robot, excitation.record, zone, command or {})
    return PreparedExcitation(request, excitation, result, objection)


def trim_to_steady_state(record: Record, motion: PreparedExcitation) -> Record:
    """Return a played record without its transient, and with its history in the metadata.

    The first period of a periodic motion is cut off, because the axis starts from rest in it. The
    history of the remaining periods is "periodic". A record is not cut if it is too short, or if
    its rows are not synchronous with the period. Its history is then the default, a start from
    rest, because a playback waits at the first row.
    """
    metadata = {name: text for name, text in record.metadata.items() if name != "history"}
    period = _find_period(record, motion)
    if period is None:
        return replace(record, metadata=metadata)
    period_count = len(record.time_s) // period
    history_metadata = {"history": "periodic", "period_samples": str(period)}
    whole_periods = record.select_rows(slice(period, period_count * period))
    return replace(whole_periods, metadata={**metadata, **history_metadata})


def _find_period(record: Record, motion: PreparedExcitation) -> int | None:
    """Return the period of a played record in rows.

    Return None if the record has fewer than three periods, or if their commands differ.
    """
    trajectory = motion.excitation.record
    if trajectory.period_samples is None or len(record.time_s) < 2:
        return None
    period_s = trajectory.period_samples / float(trajectory.metadata["rate_hz"])
    period = round(period_s * (len(record.time_s) - 1) / record.duration_s)
    period_count = len(record.time_s) // period if period else 0
    if period_count < 3:
        return None
    command = record.signal(motion.request.axis, Tap.CMD)[: period_count * period].reshape(
        period_count, period
    )
    deviation = float(np.ptp(command, axis=0).max())
    return period if deviation <= _MAX_PERIOD_DEVIATION_RATIO * float(np.ptp(command)) else None


def _make_kind(
    request: ExcitationRequest,
    amplitude: Amount | None,
    frequency_hz: float | None,
    time_s: float | None,
) -> ExcitationKind:
    middle = request.middle
    match request.wave:
        case ExcitationWave.SINE:
            return SineExcitation(
                amplitude=amplitude, offset=middle, frequency_hz=frequency_hz, duration_s=time_s
            )
        case ExcitationWave.TRIANGLE:
            return TriangleExcitation(
                amplitude=amplitude, offset=middle, frequency_hz=frequency_hz, duration_s=time_s
            )
        case ExcitationWave.MULTISINE:
            return MultisineExcitation(
                amplitude=amplitude, offset=middle, high_hz=frequency_hz, duration_s=time_s
            )
        case ExcitationWave.STAIRCASE:
            hold_s = 1.0 if time_s is None else time_s
            return StaircaseExcitation(amplitude=amplitude, offset=middle, hold_s=hold_s)


def _parse_number(name: str, text: str, unit: str) -> float | None:
    """Return a number that was typed with or without its unit, or None for an empty text."""
    digits = text.strip().removesuffix(unit).strip()
    if not text.strip():
        return None
    number = parse_number(digits)
    if number is None:
        raise ExcitationRequestError(
            tr(
                "{name}: {text} is not a number in {unit}; enter a value such as 2.5 "
                "{unit}, or leave the field empty"
            ).format(name=tr(name), text=repr(text[:40]), unit=unit)
        )
    return number


def _format_duration(seconds: float) -> str:
    return (
        f"{format_rounded(seconds, 3)} s" if seconds < 60.0 else f"{format_duration(seconds)} min"
    )


def _find_ends(run: DryRun) -> tuple[float, float]:
    """Return the lowest and the highest position of the only axis of a dry run, m or rad."""
    (axis,) = run.axes.values()
    return axis.lowest, axis.highest


def _explain_tip_bounds(
    robot: Robot, trajectory: Record, zone: KeepOutZone | None, command: Mapping[str, float]
) -> str:
    """Return why the tip would leave its limits if the other axes stay at rest, or ""."""
    if zone is None or not zone.is_bounded or set(command) != set(robot.axes):
        return ""
    positions = np.tile([command[axis] for axis in robot.axes], (len(trajectory.time_s), 1))
    for axis in trajectory.axes:
        positions[:, list(robot.axes).index(axis)] = trajectory.signal(axis, Tap.CMD)
    try:
        zone.check_path(positions, trajectory.time_s)
    except InputError as error:
        return describe_error(error)
    return ""
