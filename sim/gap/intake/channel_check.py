"""Whether readings follow their own command: else an axis is off, or channels are swapped."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Labelled
from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import Robot

_ASKED = 0.01  # of the range, that a command must span
_ASKED_FLOORS = 100.0  # and noise floors
_LEAST_GAIN = 0.1
_SURE = 3.0  # standard deviations of a gain
_ALIKE = 0.9  # correlation from which a reading is said to follow another axis


def check_following(robot: Robot, one: Labelled) -> None:
    """Check that readings follow commands, as far as other axes permit the check.

    No effect makes an axis stand still entirely; a model forced to explain it would call it contact
    or coupling.

    Raises
    ------
    GapError
        With axis, tap and, where there is one, the command that it follows instead.
    """
    record = one.record
    for axis in record.axes:
        described = robot.axes[axis]
        if not record.has(axis, Tap.CMD) or not follows_command(described, record):
            continue
        floor = described.sensor.noise_floor if described.sensor is not None else 0.0
        least = max(_ASKED * described.span, _ASKED_FLOORS * floor)
        motion = SlowMotion.of(described, record, axis)
        if motion is None or np.ptp(motion.command) < least:
            continue
        for tap in (Tap.REF, Tap.MEAS):
            if record.has(axis, tap):
                _check(one, axis, tap, motion)


def _check(one: Labelled, axis: str, tap: Tap, motion: SlowMotion) -> None:
    read = motion.read(one.record.signal(axis, tap))
    gain = _own_gain(motion, read)
    if gain is None or abs(gain[0]) + _SURE * gain[1] >= _LEAST_GAIN:
        return
    followed = [name for name, other in motion.others.items() if _alike(read, other)]
    said = (
        message(
            "gap",
            "{name}: {axis}.{tap} does not follow {axis}.cmd but {other}.cmd (its gain is {gain} ± "
            "{deviation}): channels may be swapped; correct the columns",
        )
        if followed
        else message(
            "gap",
            "{name}: {axis}.{tap} does not follow {axis}.cmd (its gain is {gain} ± {deviation}); "
            "switch the axis on, or leave its columns out",
        )
    )
    raise GapError(
        said.fill(
            name=one.name,
            axis=axis,
            tap=tap,
            other=followed[0] if followed else "",
            gain=rounded(gain[0], 2),
            deviation=rounded(gain[1], 1),
        )
    )


def _own_gain(motion: SlowMotion, read: FloatArray) -> tuple[float, float] | None:
    """Return the gain from the own command, others taken out, and its standard deviation.

    None where the own command is not told from the others.
    """
    matrix = np.column_stack([motion.command, *motion.others.values()])
    scale = np.linalg.norm(matrix, axis=0)
    matrix = matrix / scale
    if len(read) <= matrix.shape[1] or np.linalg.matrix_rank(matrix, tol=0.1) < matrix.shape[1]:
        return None
    solution, *_ = np.linalg.lstsq(matrix, read)
    left = float(np.sum((read - matrix @ solution) ** 2)) / (len(read) - matrix.shape[1])
    variance = left * float(np.linalg.inv(matrix.T @ matrix)[0, 0])
    return float(solution[0] / scale[0]), float(np.sqrt(variance) / scale[0])


def _alike(read: FloatArray, command: FloatArray) -> bool:
    size = float(np.linalg.norm(read) * np.linalg.norm(command))
    return size > 0.0 and abs(float(read @ command)) > _ALIKE * size
