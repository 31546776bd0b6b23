"""From excitations of single axes to a trajectory that the machine may play."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite, lcm
from typing import ClassVar, Protocol

import numpy as np

from rotemina.sim.excitation.draft import MOST_ROWS, Adjustment, Draft, Signal, natural_frequency
from rotemina.sim.excitation.levels import Prbs, Staircase, Steps
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.excitation.swings import DecayingTriangle, Sweeps, Triangle
from rotemina.sim.excitation.tones import Chirp, Multisine, Sine
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.limits import check_trajectory

_PER_RESONANCE = 4.0  # rows in a period of the fastest resonance, at the default rate
_RATES_HZ = (1_000.0, 2_000.0, 5_000.0, 10_000.0)
_FASTEST_HZ = 1e6
_SETPOINTS_HZ = 1_000.0  # a device's own: it holds a row until the next one is due


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
        If the robot has no such axis, or one that nothing would make follow.
    """
    if not plan:
        raise ExcitationError("excitation: no axis is named; name one at least")
    _check_names(robot, plan)
    rate = default_rate(robot, plan) if rate_hz is None else rate_hz
    _check_rate(robot, plan, rate)
    if seed < 0:
        raise ExcitationError(f"seed {seed}: must be 0 or more")
    signals, adjustments = {}, []
    for name, kind in plan.items():
        index = list(robot.axes).index(name)
        rng = np.random.default_rng([seed, index])
        draft = Draft.of(name, robot.axes[name], rate, rng, strict=strict)
        signal = kind.draw(draft)
        signals[name] = (draft, signal)
        adjustments += draft.adjustments
    record = _record(robot, plan, signals, rate, seed)
    check_trajectory(robot, record)
    return Excitation(record, tuple(adjustments))


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
                f"axis {name!r}: robot {robot.name!r} has no such axis; "
                f"use one of {', '.join(robot.axes)}"
            )


def _check_rate(robot: Robot, plan: Mapping[str, Kind], rate_hz: float) -> None:
    if not (isfinite(rate_hz) and 0 < rate_hz <= _FASTEST_HZ):
        raise ExcitationError(
            f"rate {rate_hz:.6g} Hz: must lie above 0 and up to {_FASTEST_HZ:.6g} Hz"
        )
    if rate_hz >= _SETPOINTS_HZ:
        return
    for name in plan:
        axis = robot.axes[name]
        if axis.max_speed is not None or axis.max_acceleration is not None:
            raise ExcitationError(
                f"axis {name}: rate {rate_hz:.6g} Hz is below {_SETPOINTS_HZ:.6g} Hz: the device "
                "would stand between rows and jump, beyond its speed and acceleration"
            )


def _record(
    robot: Robot,
    plan: Mapping[str, Kind],
    signals: Mapping[str, tuple[Draft, Signal]],
    rate_hz: float,
    seed: int,
) -> Record:
    rows = max(len(signal.values) for _, signal in signals.values())
    if rows * len(signals) > MOST_ROWS:
        raise ExcitationError(
            f"excitation: {rows} rows of {len(signals)} axes are more than {MOST_ROWS} values; "
            "shorten it or lower the rate"
        )
    commands = {}
    for name, (draft, signal) in signals.items():
        held = np.pad(signal.values, (0, rows - len(signal.values)), mode="edge")
        # An amplitude may be all the room that there is: rounding must not pass its ends.
        commands[name, Tap.CMD] = np.clip(held, draft.low, draft.high)
    return Record.from_signals(
        np.arange(rows) / rate_hz,
        commands,
        {name: draft.unit for name, (draft, _) in signals.items()},
        {
            **_description(robot, plan, rate_hz, seed),
            **{f"excitation {name}": _words(plan[name], s) for name, (_, s) in signals.items()},
            **_history([signal for _, signal in signals.values()], rows),
        },
    )


def _description(
    robot: Robot, plan: Mapping[str, Kind], rate_hz: float, seed: int
) -> dict[str, str]:
    kinds = ", ".join(dict.fromkeys(kind.kind for kind in plan.values()))
    return {
        "name": f"{kinds} of {', '.join(plan)}",
        "excitation": kinds,
        "robot": robot.name,
        "rate_hz": repr(rate_hz),
        "seed": str(seed),
    }


def _words(kind: Kind, signal: Signal) -> str:
    said = (f"{key} = {_plain(value)}" for key, value in signal.parameters.items())
    return "; ".join([kind.kind, *said])


def _plain(value: object) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _history(signals: list[Signal], rows: int) -> dict[str, str]:
    periods = [signal.period for signal in signals if signal.period is not None]
    if len(periods) < len(signals) or any(len(signal.values) < rows for signal in signals):
        return {}
    period = lcm(*periods)
    return {} if rows % period else {"history": "periodic", "period_samples": str(period)}
