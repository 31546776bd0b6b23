"""Check that readings follow the command of their axis.

If they do not, the axis is switched off, or channels are swapped.
"""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord
from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.records import Tap
from rotemina.sim.robot import Robot

# A reading is checked only if its command spans this fraction of the range and this many floors.
_MIN_COMMAND_SPAN_RATIO = 0.01
_MIN_COMMAND_SPAN_FLOORS = 100.0
# A gain below this means that the reading does not follow the command.
_MIN_GAIN = 0.1
# The gain must be too small by this many of its standard deviations.
_GAIN_DEVIATIONS = 3.0
# With at least this correlation, a reading is said to follow the command of another axis.
_MIN_CORRELATION = 0.9


def check_following(robot: Robot, labelled: LabelledRecord) -> None:
    """Check that readings follow commands, unless the motion of other axes prevents the check.

    No effect stops an axis completely, so a diagnosis would wrongly name contact or coupling.

    Raises
    ------
    GapError
        If a reading does not follow. The message names the axis, the tap and, if there is one, the
        command that the reading follows instead.
    """
    record = labelled.record
    for axis in record.axes:
        model = robot.axes[axis]
        if not record.has(axis, Tap.CMD) or not follows_command(model, record):
            continue
        noise_floor = model.sensor.noise_floor if model.sensor is not None else 0.0
        min_span = max(_MIN_COMMAND_SPAN_RATIO * model.span, _MIN_COMMAND_SPAN_FLOORS * noise_floor)
        motion = SlowMotion.of(model, record, axis)
        if motion is None or np.ptp(motion.command) < min_span:
            continue
        for tap in (Tap.REF, Tap.MEAS):
            if record.has(axis, tap):
                _check_channel(labelled, axis, tap, motion)


def _check_channel(labelled: LabelledRecord, axis: str, tap: Tap, motion: SlowMotion) -> None:
    averages = motion.average(labelled.record.signal(axis, tap))
    gain = _estimate_own_gain(motion, averages)
    if gain is None or abs(gain[0]) + _GAIN_DEVIATIONS * gain[1] >= _MIN_GAIN:
        return
    followed_axes = [
        name for name, other in motion.others.items() if _is_correlated(averages, other)
    ]
    template = (
        message(
            "gap",
            "{name}: {axis}.{tap} does not follow {axis}.cmd but {other}.cmd (its gain is {gain} ± "
            "{deviation}): channels may be swapped; correct the columns",
        )
        if followed_axes
        else message(
            "gap",
            "{name}: {axis}.{tap} does not follow {axis}.cmd (its gain is {gain} ± {deviation}); "
            "switch the axis on, or leave its columns out",
        )
    )
    raise GapError(
        template.fill(
            name=labelled.name,
            axis=axis,
            tap=tap,
            other=followed_axes[0] if followed_axes else "",
            gain=format_rounded(gain[0], 2),
            deviation=format_rounded(gain[1], 1),
        )
    )


def _estimate_own_gain(motion: SlowMotion, averages: FloatArray) -> tuple[float, float] | None:
    """Return the gain with respect to the command of the axis, and its standard deviation.

    The regression includes the commands of other axes. Returns None if they cannot be
    distinguished from the command of the axis.
    """
    matrix = np.column_stack([motion.command, *motion.others.values()])
    scale = np.linalg.norm(matrix, axis=0)
    matrix = matrix / scale
    if len(averages) <= matrix.shape[1] or np.linalg.matrix_rank(matrix, tol=0.1) < matrix.shape[1]:
        return None
    solution, *_ = np.linalg.lstsq(matrix, averages)
    residual_variance = float(np.sum((averages - matrix @ solution) ** 2)) / (
        len(averages) - matrix.shape[1]
    )
    variance = residual_variance * float(np.linalg.inv(matrix.T @ matrix)[0, 0])
    return float(solution[0] / scale[0]), float(np.sqrt(variance) / scale[0])


def _is_correlated(averages: FloatArray, command: FloatArray) -> bool:
    norms = float(np.linalg.norm(averages) * np.linalg.norm(command))
    return norms > 0.0 and abs(float(averages @ command)) > _MIN_CORRELATION * norms
