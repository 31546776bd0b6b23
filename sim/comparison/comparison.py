"""Deviation of the nominal model from a record of the real machine, tap by tap."""

from collections.abc import Collection
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.delay import delay
from rotemina.sim.comparison.noise_floor import noise_floor
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plant.response import Response, nominal_response
from rotemina.sim.records.record import VOLTAGE_TAPS, Record, Tap
from rotemina.sim.robot.model import Robot

FORMAT = "rotemina-comparison 1"
#: Rows, beside the first one, without which a record of a motion says nothing about a model.
LEAST_MOVING = 3
COMPARED_TAPS = (Tap.U, Tap.REF, Tap.MEAS)
FITTABLE = ("gain", "offset")


@dataclass(frozen=True, slots=True)
class TapComparison:
    """Model against real at one measured tap, in SI units.

    ``rms`` and ``peak`` of ``real − model``; ``share_of_range`` is rms over the axis' range (of
    ``u``: over its voltage range); ``relative_error`` = ‖real − model‖ / ‖real‖ with means kept;
    ``delay_s`` how much later the real signal comes; ``rms_refitted`` after gain or offset were
    re-fitted by least squares. None stands where a figure has no meaning.
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
class Comparison:
    """A record, the nominal response to its commands, and the figures of each tap."""

    record: Record
    response: Response
    taps: tuple[TapComparison, ...]

    def as_json(self) -> dict[str, Any]:
        """Return the comparison as a JSON object (format ``rotemina-comparison 1``)."""
        return {"format": FORMAT, "taps": [_plain(tap) for tap in self.taps]}


def compare(
    robot: Robot,
    record: Record,
    *,
    fit: Collection[str] = (),
    response: Response | None = None,
) -> Comparison:
    """Simulate the nominal model over a record's commands and compare every measured tap.

    Parameters
    ----------
    robot : Robot
    record : Record
        Needs ``cmd`` and at least one of ``u``, ``ref``, ``meas`` for some axis.
    fit : collection of {"gain", "offset"}
        What to re-fit by least squares for ``rms_refitted``; left out in closed loop.
    response : Response, optional
        What the model answers, where that is known already.

    Raises
    ------
    InputError
        If ``fit`` names something else, the record does not fit the robot, or nothing was measured.
    """
    for name in fit:
        if name not in FITTABLE:
            raise InputError(
                message("engine", "--fit: {name} cannot be re-fitted; choose from {names}").fill(
                    name=repr(name), names=", ".join(FITTABLE)
                )
            )
    response = nominal_response(robot, record) if response is None else response
    pairs = [
        (axis, tap)
        for axis in record.axes
        for tap in COMPARED_TAPS
        if record.has(axis, tap) and _is_answer(robot, record, axis, tap)
    ]
    if not pairs:
        raise InputError(
            message(
                "engine",
                "the record holds no measured channel (u, ref or meas) to compare; it has {names}",
            ).fill(names=", ".join(map(str, record.columns)))
        )
    _require_motion(record)
    taps = tuple(_compare_tap(robot, record, response, axis, tap, fit) for axis, tap in pairs)
    return Comparison(record, response, taps)


def _require_motion(record: Record) -> None:
    """Refuse a record that ends when its motion begins, where nothing differs from anything."""
    commands = [record.signal(axis, Tap.CMD) for axis in record.axes if record.has(axis, Tap.CMD)]
    moving = [int(np.count_nonzero(command != command[0])) for command in commands]
    most = max(moving, default=0)
    rows = len(record.time_s)
    if rows <= LEAST_MOVING or 0 < most < LEAST_MOVING:
        raise InputError(
            message(
                "engine",
                "the record has {rows} rows, {most} of them in motion; a comparison needs "
                "at least {least_moving}. Play the motion again",
            ).fill(rows=rows, most=most, least_moving=LEAST_MOVING)
        )


def _plain(tap: TapComparison) -> dict[str, Any]:
    """Return the figures with null for what is no finite number: JSON has no other word."""
    return {
        name: None if isinstance(value, float) and not np.isfinite(value) else value
        for name, value in asdict(tap).items()
    }


def _is_answer(robot: Robot, record: Record, axis: str, tap: Tap) -> bool:
    """Whether the model answers with this tap, rather than being driven by it or lacking it."""
    kind = robot.axes[axis].kind
    return tap is not Tap.U or kind == "piezo" or (kind == "force" and record.closed_loop)


def _compare_tap(
    robot: Robot, record: Record, response: Response, axis: str, tap: Tap, fit: Collection[str]
) -> TapComparison:
    real, model = record.signal(axis, tap), response.signal(axis, tap)
    difference = real - model
    rms = _rms(difference)
    size = _rms(real)
    span = _span(robot, axis, tap)
    floor = noise_floor(robot, record, axis, tap)
    return TapComparison(
        axis=axis,
        tap=str(tap),
        unit="V" if tap in VOLTAGE_TAPS else record.units[axis],
        rms=rms,
        peak=float(np.abs(difference).max()),
        share_of_range=rms / span if span else None,
        relative_error=rms / size if size > 0 else None,
        delay_s=delay(record.time_s, model, real),
        noise_floor=floor.rms,
        noise_floor_source=floor.source,
        rms_refitted=_refitted(robot, record, axis, tap, model, real, fit),
    )


def _refitted(
    robot: Robot,
    record: Record,
    axis: str,
    tap: Tap,
    model: FloatArray,
    real: FloatArray,
    fit: Collection[str],
) -> float | None:
    """RMS after least squares; gain scales the motion of the linear plant, offset shifts it."""
    if not fit or record.closed_loop:
        return None
    if tap is Tap.U:  # neither gain nor offset of the axis acts on its amplifier
        return _rms(real - model)
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
    return _rms(target - (matrix / scale) @ solution)


def _span(robot: Robot, axis: str, tap: Tap) -> float | None:
    described = robot.axes[axis]
    if tap is not Tap.U:
        return described.span
    if described.voltage_range is not None:
        return described.voltage_range[1] - described.voltage_range[0]
    return 2.0 * described.controller.limit if described.controller else None


def _rms(signal: FloatArray) -> float:
    """Return the root mean square; scaled, so that squares of huge readings stay numbers."""
    largest = float(np.abs(signal).max())
    if largest == 0.0 or not np.isfinite(largest):
        return largest
    return largest * float(np.sqrt(np.mean((signal / largest) ** 2)))
