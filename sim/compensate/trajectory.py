"""Compensation of a trajectory: the commands that produce its motion through inverses."""

from collections.abc import Mapping

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Inverse, InverseExceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.lag_and_creep import delay_rows
from rotemina.sim.errors import CompensationError
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.trajectory import commands_of
from rotemina.sim.units import format_exact

# An interval may deviate from the usual one by this share.
_MAX_UNEVENNESS_RATIO = 1e-3


def compensate_trajectory(
    robot: Robot,
    trajectory: Record,
    inverses: Mapping[str, tuple[InverseModel, str]],
    *,
    preview: bool = True,
) -> Record:
    """Return a trajectory with the commands that produce the motion of the given one.

    The rows stay the same, and so do axes without an inverse. Each axis begins at rest at the first
    row, as after a rise from the low end of its range. The metadata name the inverse:
    ``compensation zn``.

    Parameters
    ----------
    robot : Robot
    trajectory : Record
        Evenly sampled in time.
    inverses : inverse of each axis, with its name.
    preview : bool
        Whether the lag is compensated by looking ahead on the path. Otherwise it is extrapolated,
        as in a machine that does not know the path.

    Raises
    ------
    CompensationError
        If the rows are uneven, an axis is not commanded or not a piezo, the trajectory is outside
        the training range of an inverse, or a command is outside the range of the machine.
    """
    commands = commands_of(robot, trajectory)
    sample_s = _find_sample_s(trajectory.time_s)
    metadata = dict(trajectory.metadata)
    for axis, (model, name) in inverses.items():
        if not isinstance(robot.axes.get(axis), PiezoAxis) or axis not in commands:
            raise CompensationError(
                "inverse of axis {axis}: the trajectory commands {names}; it must "
                "command this piezo axis, or use the inverse of another one",
                axis=axis,
                names=", ".join(commands),
            )
        if f"compensation {axis}" in metadata:
            raise CompensationError(
                "axis {axis}: the trajectory is already compensated ({metadata}); use "
                "the original one",
                axis=axis,
                metadata=metadata[f"compensation {axis}"],
            )
        commands[axis] = _compute_commands(model, commands[axis], sample_s, preview=preview)
        metadata[f"compensation {axis}"] = name
    return Record.from_signals(
        trajectory.time_s,
        {(axis, Tap.CMD): signal for axis, signal in commands.items()},
        trajectory.units,
        metadata,
    )


def sample_at_ticks(trajectory: Record, period_s: float) -> Record:
    """Return a trajectory with a row for each tick of ``period_s``, from its first row to its last.

    It shows what a machine applies that holds each row until the next one is due.
    """
    elapsed_s = trajectory.time_s - trajectory.time_s[0]
    # Rows that are late only because of rounding count as on time.
    ticks = np.arange(int(np.ceil(elapsed_s[-1] / period_s - _MAX_UNEVENNESS_RATIO)) + 1)
    row = np.searchsorted(elapsed_s, (ticks + _MAX_UNEVENNESS_RATIO) * period_s, side="right") - 1
    commanded_axes = [axis for axis in trajectory.axes if trajectory.has(axis, Tap.CMD)]
    signals = {(axis, Tap.CMD): trajectory.signal(axis, Tap.CMD)[row] for axis in commanded_axes}
    time_s = np.asarray(ticks * period_s, dtype=np.float64)
    return Record.from_signals(time_s, signals, trajectory.units, trajectory.metadata)


def _compute_commands(
    model: InverseModel, desired: FloatArray, sample_s: float, *, preview: bool
) -> FloatArray:
    inverse = Inverse(model, sample_s, preview=preview)
    inverse.check_range(desired)
    if preview and model.lag_s:
        desired = delay_rows(desired, -model.lag_at(sample_s) / sample_s)
    command, flags = inverse.run_with_exceedances(desired)
    exceeds_command = (flags & InverseExceedance.COMMAND) != 0
    if exceeds_command.any():
        low, high = model.command_range
        row = int(np.argmax(exceeds_command))
        raise CompensationError(
            "inverse of axis {axis}: row {row} of the trajectory needs a command "
            "outside {low} to {high}, the limits of the machine; stay farther from the "
            "ends of the range",
            axis=model.axis,
            row=row,
            low=format_exact(low, model.unit, size=high),
            high=format_exact(high, model.unit),
        )
    return command


def _find_sample_s(time_s: FloatArray) -> float:
    intervals_s = np.diff(time_s)
    if len(intervals_s) == 0:
        raise CompensationError(
            "trajectory: it has only one row; an inverse needs a path of several"
        )
    sample_s = float(np.median(intervals_s))
    is_uneven = np.abs(intervals_s - sample_s) > _MAX_UNEVENNESS_RATIO * sample_s
    if is_uneven.any():
        row = int(np.argmax(is_uneven)) + 1
        raise CompensationError(
            "trajectory: row {row} comes {lengths} s after the previous one, others "
            "{sample_s} s; an inverse needs evenly spaced rows: resample the trajectory",
            row=row,
            lengths=format_rounded(intervals_s[row - 1], 6),
            sample_s=format_rounded(sample_s, 6),
        )
    return sample_s
