"""Generation of a playable trajectory from the excitations of its axes."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite
from typing import ClassVar, NamedTuple, Protocol

import numpy as np

from rotemina.sim.errors import ExcitationRequestError, OutOfLimitsError
from rotemina.sim.excitation.assembly import AxisExcitation, assemble_trajectory
from rotemina.sim.excitation.axis_draft import (
    AxisDraft,
    AxisSignal,
    ParameterAdjustment,
    compute_natural_frequency,
)
from rotemina.sim.excitation.sines_and_chirps import (
    ChirpExcitation,
    MultisineExcitation,
    SineExcitation,
)
from rotemina.sim.excitation.staircase_steps_prbs import (
    PrbsExcitation,
    StaircaseExcitation,
    StepsExcitation,
)
from rotemina.sim.excitation.triangles_and_sweeps import (
    DecayingTriangleExcitation,
    SweepsExcitation,
    TriangleExcitation,
)
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import (
    DEFAULT_SETPOINT_PERIOD_S,
    LimitedQuantity,
    LimitViolation,
    dry_run,
)

# The default rate has at least this many rows in a period of the fastest resonance.
_ROWS_PER_RESONANCE = 4.0
_DEFAULT_RATES_HZ = (1_000.0, 2_000.0, 5_000.0, 10_000.0)
_MAX_RATE_HZ = 1e6
# At lower rates, a device rests on each row until the next one is due.
_MIN_RATE_HZ = 1.0 / DEFAULT_SETPOINT_PERIOD_S

# The amplitudes are reduced up to this many times, until the predicted motion stays in the range.
_MAX_TRIES = 10
# Each try multiplies the amplitude by this factor or a smaller one.
_MAX_REDUCTION_FACTOR = 0.95
_COMMAND_QUANTITIES = (
    LimitedQuantity.RANGE,
    LimitedQuantity.VOLTAGE,
    LimitedQuantity.SPEED,
    LimitedQuantity.ACCELERATION,
)


class ExcitationKind(Protocol):
    """A kind of excitation with its parameters, from which the signal of an axis can be drawn."""

    kind: ClassVar[str]

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the signal of an axis, within the limits of the axis."""


EXCITATION_KINDS: Mapping[str, type[ExcitationKind]] = {
    each.kind: each
    for each in (
        SineExcitation,
        TriangleExcitation,
        DecayingTriangleExcitation,
        StaircaseExcitation,
        MultisineExcitation,
        ChirpExcitation,
        PrbsExcitation,
        SweepsExcitation,
        StepsExcitation,
    )
}


@dataclass(frozen=True, slots=True)
class Excitation:
    """A trajectory, and the adjustments to keep it within limits and on whole rows."""

    record: Record
    adjustments: tuple[ParameterAdjustment, ...]


def excite(
    robot: Robot,
    plan: Mapping[str, ExcitationKind],
    *,
    rate_hz: float | None = None,
    seed: int = 0,
    strict: bool = False,
) -> Excitation:
    """Return a trajectory that excites all axes of ``plan`` at the same time.

    Parameters
    ----------
    robot : robot whose limits apply.
    plan : axis -> excitation of that axis.
    rate_hz : rows per second; by default enough for the fastest resonance of the axes.
    seed : seed of phases and sequences. The signal of an axis does not depend on the other axes.
    strict : raise an error for a value that exceeds a limit, instead of reducing it.

    Returns
    -------
    Excitation
        Axes that finish early rest at their last position until the end. The record is marked as
        periodic if every axis is periodic and their common period divides its length.

    Raises
    ------
    ExcitationRequestError
        If a parameter is impossible, or exceeds a limit and ``strict`` is set. The message names
        the axis, the value and the bound.
    TrajectoryError
        If an axis cannot follow commands.
    OutOfLimitsError
        If the model predicts a motion beyond the range at any amplitude.
    """
    if not plan:
        raise ExcitationRequestError("excitation: no axis is named; name at least one")
    _check_names(robot, plan)
    rate = choose_default_rate(robot, plan) if rate_hz is None else rate_hz
    _check_rate(robot, plan, rate)
    if seed < 0:
        raise ExcitationRequestError("seed {seed}: must be 0 or more", seed=seed)
    request = _Request(robot, plan, rate, seed, strict)
    max_amplitudes: dict[str, float] = {}
    for _ in range(_MAX_TRIES):
        parts = _draw_axes(request, max_amplitudes)
        record = assemble_trajectory(parts, rate, {"robot": robot.name, "seed": str(seed)})
        violations = dry_run(robot, record).violations
        if not violations:
            adjustments = (
                adjustment for part in parts.values() for adjustment in part.draft.adjustments
            )
            return Excitation(record, tuple(adjustments))
        max_amplitudes |= {
            violation.axis: _reduce_amplitude(parts[violation.axis].draft, violation)
            for violation in violations
        }
    raise OutOfLimitsError(violations[0].message)


class _Request(NamedTuple):
    robot: Robot
    plan: Mapping[str, ExcitationKind]
    rate_hz: float
    seed: int
    strict: bool


def _draw_axes(request: _Request, max_amplitudes: Mapping[str, float]) -> dict[str, AxisExcitation]:
    parts = {}
    for name, excitation in request.plan.items():
        rng = np.random.default_rng([request.seed, list(request.robot.axes).index(name)])
        draft = AxisDraft.of(
            name,
            request.robot.axes[name],
            request.rate_hz,
            rng,
            strict=request.strict,
            max_amplitude=max_amplitudes.get(name, inf),
        )
        parts[name] = AxisExcitation(excitation.kind, draft, excitation.draw(draft))
    return parts


def _reduce_amplitude(draft: AxisDraft, violation: LimitViolation) -> float:
    """Return an amplitude with which an axis is expected to stay in its range, m or rad.

    The commands are within every limit, so only the predicted motion can exceed one. In a linear
    model, the motion is proportional to the amplitude.
    """
    if violation.quantity in _COMMAND_QUANTITIES or violation.value == draft.chosen_offset:
        raise OutOfLimitsError(violation.message)
    reduction = (violation.bound - draft.chosen_offset) / (violation.value - draft.chosen_offset)
    return draft.chosen_amplitude * min(reduction, _MAX_REDUCTION_FACTOR)


def choose_default_rate(robot: Robot, plan: Mapping[str, ExcitationKind]) -> float:
    """Return a rate with at least four rows per period of the fastest resonance of the axes, Hz.

    The rate is 1, 2, 5 or 10 kHz.
    """
    resonances = (compute_natural_frequency(robot.axes[name]) for name in plan)
    needed = _ROWS_PER_RESONANCE * max(
        (resonance_hz for resonance_hz in resonances if resonance_hz is not None), default=0.0
    )
    return next((rate for rate in _DEFAULT_RATES_HZ if rate >= needed), _DEFAULT_RATES_HZ[-1])


def _check_names(robot: Robot, plan: Mapping[str, ExcitationKind]) -> None:
    for name in plan:
        if name not in robot.axes:
            raise ExcitationRequestError(
                "axis {name}: robot {robot_name} has no such axis; use one of {names}",
                name=repr(name),
                robot_name=repr(robot.name),
                names=", ".join(robot.axes),
            )


def _check_rate(robot: Robot, plan: Mapping[str, ExcitationKind], rate_hz: float) -> None:
    if not (isfinite(rate_hz) and 0 < rate_hz <= _MAX_RATE_HZ):
        raise ExcitationRequestError(
            "rate {rate_hz} Hz: must lie above 0 and up to {fastest_hz} Hz",
            rate_hz=format_rounded(rate_hz, 6),
            fastest_hz=format_rounded(_MAX_RATE_HZ, 6),
        )
    if rate_hz >= _MIN_RATE_HZ:
        return
    for name in plan:
        axis = robot.axes[name]
        if axis.max_speed is not None or axis.max_acceleration is not None:
            raise ExcitationRequestError(
                "axis {name}: rate {rate_hz} Hz is below {slowest_hz} Hz: the device "
                "would rest between rows and jump, which exceeds its speed and acceleration",
                name=name,
                rate_hz=format_rounded(rate_hz, 6),
                slowest_hz=format_rounded(_MIN_RATE_HZ, 6),
            )
