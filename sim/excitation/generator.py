"""Generation of a playable trajectory from excitations of single axes."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite
from typing import ClassVar, NamedTuple, Protocol

import numpy as np

from rotemina.sim.excitation.assembly import Drawn, assembled
from rotemina.sim.excitation.axis_draft import Adjustment, Draft, Signal, natural_frequency
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.excitation.sines_and_chirps import Chirp, Multisine, Sine
from rotemina.sim.excitation.staircase_steps_prbs import Prbs, Staircase, Steps
from rotemina.sim.excitation.triangles_and_sweeps import DecayingTriangle, Sweeps, Triangle
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.dry_run import dry_run
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S
from rotemina.sim.trajectory.trajectory_excesses import Quantity, Violation

_PER_RESONANCE = 4.0  # rows in a period of the fastest resonance, at the default rate
_RATES_HZ = (1_000.0, 2_000.0, 5_000.0, 10_000.0)
_FASTEST_HZ = 1e6
_SLOWEST_HZ = 1.0 / SETPOINT_PERIOD_S  # a device holds a row until the next one is due

_TRIES = 10  # at amplitudes with which the predicted motion, too, stays inside the range
_SMALLER = 0.95  # at most, from try to try
_OF_COMMANDS = (Quantity.RANGE, Quantity.VOLTAGE, Quantity.SPEED, Quantity.ACCELERATION)


class Kind(Protocol):
    """What an excitation is: its parameters, and how it is drawn for one axis."""

    kind: ClassVar[str]

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis inside its limits."""


KINDS: Mapping[str, type[Kind]] = {
    each.kind: each
    for each in (
        Sine,
        Triangle,
        DecayingTriangle,
        Staircase,
        Multisine,
        Chirp,
        Prbs,
        Sweeps,
        Steps,
    )
}


@dataclass(frozen=True, slots=True)
class Excitation:
    """A trajectory, and what had to be changed to keep it inside the limits or on whole rows."""

    record: Record
    adjustments: tuple[Adjustment, ...]


def excite(
    robot: Robot,
    plan: Mapping[str, Kind],
    *,
    rate_hz: float | None = None,
    seed: int = 0,
    strict: bool = False,
) -> Excitation:
    """Return the trajectory that excites each axis of ``plan`` by its own excitation, all at once.

    Parameters
    ----------
    robot : whose limits hold.
    plan : axis -> excitation.
    rate_hz : rows a second; by default enough for the fastest resonance of the axes.
    seed : of phases and sequences. An axis' signal does not depend on the other axes.
    strict : refuse what exceeds a limit, instead of reducing it.

    Returns
    -------
    Excitation
        An axis that is done rests at its last position until all are. The record is marked
        periodic where every axis is, and their common period fits whole times into it.

    Raises
    ------
    ExcitationError
        If a parameter is impossible, or in a strict run exceeds a limit: with axis, value, bound.
    TrajectoryError
        If nothing would make an axis follow.
    OutOfLimitsError
        If the model predicts a motion beyond the range whatever the amplitude.
    """
    if not plan:
        raise ExcitationError(message("engine", "excitation: no axis is named; name at least one"))
    _check_names(robot, plan)
    rate = default_rate(robot, plan) if rate_hz is None else rate_hz
    _check_rate(robot, plan, rate)
    if seed < 0:
        raise ExcitationError(message("engine", "seed {seed}: must be 0 or more").fill(seed=seed))
    request = _Request(robot, plan, rate, seed, strict)
    most: dict[str, float] = {}
    for _ in range(_TRIES):
        parts = _drawn(request, most)
        record = assembled(parts, rate, {"robot": robot.name, "seed": str(seed)})
        beyond = dry_run(robot, record).violations
        if not beyond:
            changes = (each for part in parts.values() for each in part.draft.adjustments)
            return Excitation(record, tuple(changes))
        most |= {each.axis: _smaller(parts[each.axis].draft, each) for each in beyond}
    raise OutOfLimitsError(beyond[0].message)


class _Request(NamedTuple):
    robot: Robot
    plan: Mapping[str, Kind]
    rate_hz: float
    seed: int
    strict: bool


def _drawn(request: _Request, most: Mapping[str, float]) -> dict[str, Drawn]:
    """Draw every axis with the amplitudes that it may have at most, m or rad."""
    parts = {}
    for name, kind in request.plan.items():
        rng = np.random.default_rng([request.seed, list(request.robot.axes).index(name)])
        draft = Draft.of(
            name,
            request.robot.axes[name],
            request.rate_hz,
            rng,
            strict=request.strict,
            most=most.get(name, inf),
        )
        parts[name] = Drawn(kind.kind, draft, kind.draw(draft))
    return parts


def _smaller(draft: Draft, beyond: Violation) -> float:
    """Return the amplitude with which an axis ought to stay inside, m or rad.

    Commands are inside every limit, so what goes beyond is the motion that the model predicts:
    in a linear model it grows with the amplitude.
    """
    if beyond.quantity in _OF_COMMANDS or beyond.value == draft.centre:
        raise OutOfLimitsError(beyond.message)
    share = (beyond.bound - draft.centre) / (beyond.value - draft.centre)
    return draft.reach * min(share, _SMALLER)


def default_rate(robot: Robot, plan: Mapping[str, Kind]) -> float:
    """Return a rate with at least four rows in a period of the fastest resonance of the axes, Hz.

    That is 1, 2, 5 or 10 kHz.
    """
    resonances = (natural_frequency(robot.axes[name]) for name in plan)
    needed = _PER_RESONANCE * max((each for each in resonances if each is not None), default=0.0)
    return next((rate for rate in _RATES_HZ if rate >= needed), _RATES_HZ[-1])


def _check_names(robot: Robot, plan: Mapping[str, Kind]) -> None:
    for name in plan:
        if name not in robot.axes:
            raise ExcitationError(
                message(
                    "engine", "axis {name}: robot {robot_name} has no such axis; use one of {names}"
                ).fill(name=repr(name), robot_name=repr(robot.name), names=", ".join(robot.axes))
            )


def _check_rate(robot: Robot, plan: Mapping[str, Kind], rate_hz: float) -> None:
    if not (isfinite(rate_hz) and 0 < rate_hz <= _FASTEST_HZ):
        raise ExcitationError(
            message("engine", "rate {rate_hz} Hz: must lie above 0 and up to {fastest_hz} Hz").fill(
                rate_hz=rounded(rate_hz, 6), fastest_hz=rounded(_FASTEST_HZ, 6)
            )
        )
    if rate_hz >= _SLOWEST_HZ:
        return
    for name in plan:
        axis = robot.axes[name]
        if axis.max_speed is not None or axis.max_acceleration is not None:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {name}: rate {rate_hz} Hz is below {slowest_hz} Hz: the device "
                    "would rest between rows and jump, which exceeds its speed and acceleration",
                ).fill(name=name, rate_hz=rounded(rate_hz, 6), slowest_hz=rounded(_SLOWEST_HZ, 6))
            )
