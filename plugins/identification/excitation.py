"""The excitation of an axis requested by the operator, its motion, and its checks."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.display_units import duration_text, label
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.views import View
from rotemina.sim.errors import InputError
from rotemina.sim.excitation.generator import Excitation, Kind, excite
from rotemina.sim.excitation.quantity import Amount, ExcitationError, amount_of
from rotemina.sim.excitation.sines_and_chirps import Multisine, Sine
from rotemina.sim.excitation.staircase_steps_prbs import Staircase
from rotemina.sim.excitation.triangles_and_sweeps import Triangle
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.quantities import exact, parsed, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.dry_run import DryRun, dry_run

_SAME = 1e-9  # of the swing: commands that differ by less are the same


class Wave(StrEnum):
    """The motions that are offered, as trajectories are named."""

    MULTISINE = mark("Multisine")
    SINE = mark("Sine")
    TRIANGLE = mark("Triangle")
    STAIRCASE = mark("Staircase")


VIEWS: Mapping[Wave, View] = {
    Wave.MULTISINE: View.FREQUENCY,
    Wave.SINE: View.LOOP,
    Wave.TRIANGLE: View.LOOP,
    Wave.STAIRCASE: View.STEPS,
}


@dataclass(frozen=True, slots=True)
class ExcitationRequest:
    """What was typed, each text empty where the default is to hold.

    Attributes
    ----------
    axis, wave : which axis, and how it moves.
    amplitude : to each side of the middle, as ``5um`` or ``30%`` of the range.
    frequency : Hz; of a multisine the highest.
    time : s; the duration, and of a staircase the rest on each level.
    about : middle of the motion, m or rad; None for that of the range.
    """

    axis: str
    wave: Wave
    amplitude: str = ""
    frequency: str = ""
    time: str = ""
    about: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A motion that was made and tried on the model.

    Attributes
    ----------
    request : what it was made from.
    made : the trajectory, and what was changed to keep limits.
    dry_run : what the model says of it.
    objection : why it must not be played, "" where it may.
    """

    request: ExcitationRequest
    made: Excitation
    dry_run: DryRun
    objection: str

    @property
    def name(self) -> str:
        """What the motion is called."""
        return f"{self.request.wave} of {label(self.request.axis)}"

    @property
    def digest(self) -> str | None:
        """By which a record tells that this was played; None where it must not be."""
        checked = self.dry_run.checked
        return None if checked is None or self.objection else checked.digest

    @property
    def words(self) -> str:
        """What it asks of the axis, what was changed, and what the dry run says, as shown."""
        axis = self.dry_run.axes[self.request.axis]
        low, high = (exact(end, axis.unit, size=axis.highest) for end in _ends(self.dry_run))
        unit = f"{axis.unit}/s"
        asks = tr("{low} to {high}, at most {speed}, {time}")
        if axis.bounds.max_speed is not None:
            asks = tr("{low} to {high}, at most {speed} of {bound}, {time}")
        asks = asks.format(
            low=low,
            high=high,
            speed=exact(axis.peak_speed, unit),
            bound=exact(axis.bounds.max_speed or 0.0, unit),
            time=_lasting(self.dry_run.duration_s),
        )
        change = tr("Reduced to the limits: {change}.")
        changed = (change.format(change=spoken(each.message)) for each in self.made.adjustments)
        verdict = tr("Dry run: within all limits and the bounds of the tip.")
        if self.objection:
            verdict = tr("Not playable: {reason}")
        return "\n".join([asks, *changed, verdict.format(reason=self.objection)])


def prepared(
    robot: Robot,
    request: ExcitationRequest,
    setpoint_period_s: float,
    zone: KeepOutZone | None = None,
    command: Mapping[str, float] | None = None,
) -> Prepared:
    """Make the motion that is wished for, and try it on the model.

    Parameters
    ----------
    robot : Robot
    request : ExcitationRequest
    setpoint_period_s : of the device that shall play it.
    zone : the tip's bounds now, as the session has them.
    command : axis -> where it stands, m or rad; the other axes stay there.

    Raises
    ------
    InputError
        If a text is no amount, frequency or time, or the motion is impossible.
    """
    unit = robot.unit(request.axis) or "m"
    size = amount_of(request.amplitude, request.axis, unit) if request.amplitude.strip() else None
    hz, time_s = (
        _number(mark("frequency"), request.frequency, "Hz"),
        _number(mark("time"), request.time, "s"),
    )
    made = excite(robot, {request.axis: _kind(request, size, hz, time_s)})
    tried = dry_run(robot, made.record, setpoint_period_s=setpoint_period_s)
    objection = next(iter(tried.objections), "")
    if not objection:
        objection = _out_of_bounds(robot, made.record, zone, command or {})
    return Prepared(request, made, tried, objection)


def steady(record: Record, motion: Prepared) -> Record:
    """Return a played record with what is known of the time before its first row.

    A periodic motion is left without its first period, in which the axis comes from rest, and
    marked as in its steady state; where it is too short for that, or was not sampled in step with
    its period, it began at rest as any other one: a playback waits on the first row.
    """
    rest = {name: text for name, text in record.metadata.items() if name != "history"}
    period = _period(record, motion)
    if period is None:
        return replace(record, metadata=rest)
    whole = len(record.time_s) // period
    marks = {"history": "periodic", "period_samples": str(period)}
    kept = record.part(slice(period, whole * period))
    return replace(kept, metadata={**rest, **marks})


def _period(record: Record, motion: Prepared) -> int | None:
    """Return the rows after which a played record repeats itself, three times or more."""
    asked = motion.made.record
    if asked.period_samples is None or len(record.time_s) < 2:
        return None
    period_s = asked.period_samples / float(asked.metadata["rate_hz"])
    period = round(period_s * (len(record.time_s) - 1) / record.duration_s)
    whole = len(record.time_s) // period if period else 0
    if whole < 3:
        return None
    command = record.signal(motion.request.axis, Tap.CMD)[: whole * period].reshape(whole, period)
    apart = float(np.ptp(command, axis=0).max())
    return period if apart <= _SAME * float(np.ptp(command)) else None


def _kind(
    request: ExcitationRequest, size: Amount | None, hz: float | None, time_s: float | None
) -> Kind:
    about = request.about
    match request.wave:
        case Wave.SINE:
            return Sine(amplitude=size, offset=about, frequency_hz=hz, duration_s=time_s)
        case Wave.TRIANGLE:
            return Triangle(amplitude=size, offset=about, frequency_hz=hz, duration_s=time_s)
        case Wave.MULTISINE:
            return Multisine(amplitude=size, offset=about, high_hz=hz, duration_s=time_s)
        case Wave.STAIRCASE:
            rest_s = 1.0 if time_s is None else time_s
            return Staircase(amplitude=size, offset=about, hold_s=rest_s)


def _number(name: str, text: str, unit: str) -> float | None:
    """Read a number with or without its unit; None for no text."""
    digits = text.strip().removesuffix(unit).strip()
    if not text.strip():
        return None
    number = parsed(digits)
    if number is None:
        raise ExcitationError(
            tr(
                "{name}: {text} is not a number in {unit}; enter a value such as 2.5 "
                "{unit}, or leave the field empty"
            ).format(name=tr(name), text=repr(text[:40]), unit=unit)
        )
    return number


def _lasting(seconds: float) -> str:
    return f"{rounded(seconds, 3)} s" if seconds < 60.0 else f"{duration_text(seconds)} min"


def _ends(run: DryRun) -> tuple[float, float]:
    (axis,) = run.axes.values()
    return axis.lowest, axis.highest


def _out_of_bounds(
    robot: Robot, trajectory: Record, zone: KeepOutZone | None, command: Mapping[str, float]
) -> str:
    """Return why the tip would leave its bounds while the other axes stay, "" where it does not."""
    if zone is None or not zone.bounded or set(command) != set(robot.axes):
        return ""
    positions = np.tile([command[axis] for axis in robot.axes], (len(trajectory.time_s), 1))
    for axis in trajectory.axes:
        positions[:, list(robot.axes).index(axis)] = trajectory.signal(axis, Tap.CMD)
    try:
        zone.check_path(positions, trajectory.time_s)
    except InputError as error:
        return error_text(error)
    return ""
