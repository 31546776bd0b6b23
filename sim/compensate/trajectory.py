"""A trajectory sent through inverses: the commands that produce the desired motion."""

from collections.abc import Mapping

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.lag_and_creep import delayed
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import PiezoAxis, Robot
from rotemina.sim.trajectory.trajectory_excesses import commands_of

_UNEVEN = 1e-3  # of a row's interval


def compensated(
    robot: Robot,
    trajectory: Record,
    inverses: Mapping[str, tuple[InverseModel, str]],
    *,
    preview: bool = True,
) -> Record:
    """Return a trajectory with the commands that bring its own about; axes without inverse as is.

    Rows stay. The axis begins at rest at the first row, as after a rise from the low end of its
    range. Metadata name the inverse: ``compensation zn``.

    Parameters
    ----------
    robot : Robot
    trajectory : Record
        Evenly sampled in time.
    inverses : by axis, with what they are to be called.
    preview : whether the lag is made up for by looking ahead on the path; else as a machine that
        does not know it does, by extrapolation.

    Raises
    ------
    CompensationError
        If rows are uneven, an axis is not commanded or no piezo, the trajectory goes beyond what
        an inverse saw, or the machine cannot be told what it asks for.
    """
    commands = commands_of(robot, trajectory)
    sample_s = _sample_s(trajectory.time_s)
    metadata = dict(trajectory.metadata)
    for axis, (model, name) in inverses.items():
        if not isinstance(robot.axes.get(axis), PiezoAxis) or axis not in commands:
            raise CompensationError(
                message(
                    "engine",
                    "inverse of axis {axis}: the trajectory commands {names}; it must "
                    "command this piezo axis, or use the inverse of another one",
                ).fill(axis=axis, names=", ".join(commands))
            )
        if f"compensation {axis}" in metadata:
            raise CompensationError(
                message(
                    "engine",
                    "axis {axis}: the trajectory is already compensated ({metadata}); use "
                    "the original one",
                ).fill(axis=axis, metadata=metadata[f"compensation {axis}"])
            )
        commands[axis] = _sent(model, commands[axis], sample_s, preview=preview)
        metadata[f"compensation {axis}"] = name
    return Record.from_signals(
        trajectory.time_s,
        {(axis, Tap.CMD): signal for axis, signal in commands.items()},
        trajectory.units,
        metadata,
    )


def on_ticks(trajectory: Record, period_s: float) -> Record:
    """Return a trajectory as a machine applies it that holds each row until a tick after the next.

    It has a row for each tick of ``period_s``, from its first row to its last.
    """
    since_s = trajectory.time_s - trajectory.time_s[0]
    # What is late by rounding is on time.
    ticks = np.arange(int(np.ceil(since_s[-1] / period_s - _UNEVEN)) + 1)
    row = np.searchsorted(since_s, (ticks + _UNEVEN) * period_s, side="right") - 1
    commanded = [axis for axis in trajectory.axes if trajectory.has(axis, Tap.CMD)]
    signals = {(axis, Tap.CMD): trajectory.signal(axis, Tap.CMD)[row] for axis in commanded}
    time_s = np.asarray(ticks * period_s, dtype=np.float64)
    return Record.from_signals(time_s, signals, trajectory.units, trajectory.metadata)


def _sent(
    model: InverseModel, desired: FloatArray, sample_s: float, *, preview: bool
) -> FloatArray:
    inverse = Inverse(model, sample_s, preview=preview)
    inverse.check(desired)
    if preview and model.lag_s:
        desired = delayed(desired, -model.lag_at(sample_s) / sample_s)
    sent, said = inverse.run_and_tell(desired)
    beyond = (said & Exceedance.COMMAND) != 0
    if beyond.any():
        low, high = model.command_range
        row = int(np.argmax(beyond))
        raise CompensationError(
            message(
                "engine",
                "inverse of axis {axis}: row {row} of the trajectory needs a command "
                "outside {low} to {high}, the limits of the machine; stay farther from the "
                "ends of the range",
            ).fill(
                axis=model.axis,
                row=row,
                low=exact(low, model.unit, size=high),
                high=exact(high, model.unit),
            )
        )
    return sent


def _sample_s(time_s: FloatArray) -> float:
    lengths = np.diff(time_s)
    if len(lengths) == 0:
        raise CompensationError(
            message("engine", "trajectory: it has only one row; an inverse needs a path of several")
        )
    sample_s = float(np.median(lengths))
    uneven = np.abs(lengths - sample_s) > _UNEVEN * sample_s
    if uneven.any():
        row = int(np.argmax(uneven)) + 1
        raise CompensationError(
            message(
                "engine",
                "trajectory: row {row} comes {lengths} s after the previous one, others "
                "{sample_s} s; an inverse needs evenly spaced rows: resample the trajectory",
            ).fill(row=row, lengths=rounded(lengths[row - 1], 6), sample_s=rounded(sample_s, 6))
        )
    return sample_s
