"""Comparison of the nominal model with a record of the real machine, tap by tap."""

from collections.abc import Collection
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.delay import estimate_delay
from rotemina.sim.comparison.noise_floor import find_noise_floor
from rotemina.sim.errors import InputError
from rotemina.sim.plant import ModelResponse, simulate_nominal_response
from rotemina.sim.records import (
    VOLTAGE_TAPS,
    Record,
    Tap,
)
from rotemina.sim.robot import Robot

COMPARISON_FORMAT = "rotemina-comparison 1"
#: A comparison needs at least this many rows in motion, in addition to the first row.
MIN_MOVING_ROWS = 3
COMPARED_TAPS = (Tap.U, Tap.REF, Tap.MEAS)
FITTABLE_PARAMETERS = ("gain", "offset")


@dataclass(frozen=True, slots=True)
class TapComparison:
    """Figures of one measured tap against the model, in SI units.

    A figure is None if it has no meaning for the tap.

    Attributes
    ----------
    axis, tap, unit : axis, tap and SI unit of the signal.
    rms, peak : rms and largest absolute value of ``real − model``.
    share_of_range : rms divided by the range of the axis; for ``u``, by its voltage range.
    relative_error : ‖real − model‖ / ‖real‖; means are not removed.
    delay_s : time by which the real signal lags the model.
    noise_floor, noise_floor_source : rms that no model can explain, and where it comes from.
    rms_refitted : rms after gain or offset were re-fitted by least squares.
    """

    axis: str
    tap: str
    unit: str
    rms: float
    peak: float
    share_of_range: float | None
    relative_error: float | None
    delay_s: float | None
    noise_floor: float | None
    noise_floor_source: str | None
    rms_refitted: float | None


@dataclass(frozen=True, slots=True, eq=False)
class ModelComparison:
    """A record, the nominal response to its commands, and the figures of each tap."""

    record: Record
    response: ModelResponse
    taps: tuple[TapComparison, ...]

    def as_json(self) -> dict[str, Any]:
        """Return the comparison as a JSON object (format ``rotemina-comparison 1``)."""
        return {"format": COMPARISON_FORMAT, "taps": [_to_json_values(tap) for tap in self.taps]}


def compare(
    robot: Robot,
    record: Record,
    *,
    fit: Collection[str] = (),
    response: ModelResponse | None = None,
) -> ModelComparison:
    """Simulate the nominal model with a record's commands and compare every measured tap.

    Parameters
    ----------
    robot : Robot
    record : Record
        Needs ``cmd`` and at least one of ``u``, ``ref``, ``meas`` for some axis.
    fit : collection of {"gain", "offset"}
        Parameters to re-fit by least squares for ``rms_refitted``; ignored in closed loop.
    response : ModelResponse, optional
        The response of the model, if it has already been computed.

    Raises
    ------
    InputError
        If ``fit`` names something else, the record does not fit the robot, or nothing was measured.
    """
    for name in fit:
        if name not in FITTABLE_PARAMETERS:
            raise InputError(
                "--fit: {name} cannot be re-fitted; choose from {names}",
                name=repr(name),
                names=", ".join(FITTABLE_PARAMETERS),
            )
    response = simulate_nominal_response(robot, record) if response is None else response
    pairs = [
        (axis, tap)
        for axis in record.axes
        for tap in COMPARED_TAPS
        if record.has(axis, tap) and _is_predicted(robot, record, axis, tap)
    ]
    if not pairs:
        raise InputError(
            "the record holds no measured channel (u, ref or meas) to compare; it has {names}",
            names=", ".join(map(str, record.columns)),
        )
    _require_motion(record)
    taps = tuple(_compare_tap(robot, record, response, axis, tap, fit) for axis, tap in pairs)
    return ModelComparison(record, response, taps)


def _require_motion(record: Record) -> None:
    """Raise InputError if the record ends when its motion begins.

    All models would agree with such a record.
    """
    commands = [record.signal(axis, Tap.CMD) for axis in record.axes if record.has(axis, Tap.CMD)]
    moving_row_counts = [int(np.count_nonzero(command != command[0])) for command in commands]
    max_moving_rows = max(moving_row_counts, default=0)
    rows = len(record.time_s)
    if rows <= MIN_MOVING_ROWS or 0 < max_moving_rows < MIN_MOVING_ROWS:
        raise InputError(
            "the record has {rows} rows, {most} of them in motion; a comparison needs "
            "at least {least_moving}. Play the motion again",
            rows=rows,
            most=max_moving_rows,
            least_moving=MIN_MOVING_ROWS,
        )


def _to_json_values(tap: TapComparison) -> dict[str, Any]:
    """Return the figures; values that are not finite become None, because JSON lacks them."""
    return {
        name: None if isinstance(value, float) and not np.isfinite(value) else value
        for name, value in asdict(tap).items()
    }


def _is_predicted(robot: Robot, record: Record, axis: str, tap: Tap) -> bool:
    """Return whether the model predicts this tap: not if it lacks it or takes it as an input."""
    kind = robot.axes[axis].kind
    return tap is not Tap.U or kind == "piezo" or (kind == "force" and record.closed_loop)


def _compare_tap(
    robot: Robot, record: Record, response: ModelResponse, axis: str, tap: Tap, fit: Collection[str]
) -> TapComparison:
    real, model = record.signal(axis, tap), response.signal(axis, tap)
    difference = real - model
    rms = _compute_rms(difference)
    rms_of_real = _compute_rms(real)
    span = _find_span(robot, axis, tap)
    floor = find_noise_floor(robot, record, axis, tap)
    return TapComparison(
        axis=axis,
        tap=str(tap),
        unit="V" if tap in VOLTAGE_TAPS else record.units[axis],
        rms=rms,
        peak=float(np.abs(difference).max()),
        share_of_range=rms / span if span else None,
        relative_error=rms / rms_of_real if rms_of_real > 0 else None,
        delay_s=estimate_delay(record.time_s, model, real),
        noise_floor=floor.rms,
        noise_floor_source=floor.source,
        rms_refitted=_compute_refitted_rms(robot, record, axis, tap, model, real, fit),
    )


def _compute_refitted_rms(
    robot: Robot,
    record: Record,
    axis: str,
    tap: Tap,
    model: FloatArray,
    real: FloatArray,
    fit: Collection[str],
) -> float | None:
    """Return the rms difference after re-fitting the parameters in ``fit`` by least squares.

    The gain scales the motion of the linear plant, and the offset shifts it.
    """
    if not fit or record.closed_loop:
        return None
    # The gain and the offset of the axis do not affect the output of its amplifier.
    if tap is Tap.U:
        return _compute_rms(real - model)
    offset = robot.axes[axis].offset if tap is Tap.MEAS else 0.0
    motion = model - offset
    columns, target = [], real - offset
    if "gain" in fit:
        columns.append(motion)
    else:
        target = target - motion
    if "offset" in fit:
        columns.append(np.ones_like(motion))
    matrix = np.column_stack(columns)
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0.0] = 1.0
    solution, *_ = np.linalg.lstsq(matrix / scale, target, rcond=None)
    return _compute_rms(target - (matrix / scale) @ solution)


def _find_span(robot: Robot, axis: str, tap: Tap) -> float | None:
    axis_model = robot.axes[axis]
    if tap is not Tap.U:
        return axis_model.span
    if axis_model.voltage_range is not None:
        return axis_model.voltage_range[1] - axis_model.voltage_range[0]
    return 2.0 * axis_model.controller.limit if axis_model.controller else None


def _compute_rms(signal: FloatArray) -> float:
    # The signal is scaled, so that the squares of huge readings do not overflow.
    largest = float(np.abs(signal).max())
    if largest == 0.0 or not np.isfinite(largest):
        return largest
    return largest * float(np.sqrt(np.mean((signal / largest) ** 2)))
