"""Units, decimals and axis labels for display, without Qt."""

import math
from typing import TYPE_CHECKING

from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.messages import (
    count_decimals,
    format_fixed,
    format_rounded,
)
from rotemina.sim.records import Record, find_max_speeds
from rotemina.sim.robot import Axis, Robot
from rotemina.sim.units import (
    DisplayScale,
    choose_scale,
    make_scale,
    to_unit,
)

AXIS_LABELS = {"x": "X", "y": "Y", "z": "Z", "thx": "θx", "thy": "θy", "zn": "Z nano"}
# Positions of an axis with at least this range are easier to read in mm than in µm.
_MIN_SPAN_FOR_MM_M = 1e-3


def choose_axis_scale(axis: Axis) -> DisplayScale:
    """Choose unit and digits for an axis from its range and the resolution of its sensor."""
    if axis.unit == "rad":
        unit = "urad"
    else:
        unit = "mm" if axis.span >= _MIN_SPAN_FOR_MM_M else "um"
    resolution = axis.sensor.resolution if axis.sensor else 0.0
    resolution = resolution or axis.span / 1e5
    return make_scale(unit, decimals=count_decimals(float(to_unit(resolution, unit))))


def find_noticeable_change(axis: Axis) -> float:
    """Return the smallest change of a reading that noise alone does not explain, m or rad.

    It is three noise floors of the sensor or two resolution steps, whichever is larger, and 0 for
    an axis without a sensor.
    """
    sensor = axis.sensor
    return max(3.0 * sensor.noise_floor, 2.0 * sensor.resolution) if sensor else 0.0


def get_axis_label(axis: str) -> str:
    """Return the label that operators see for an axis, such as ``θx`` for ``thx``."""
    return AXIS_LABELS.get(axis, axis)


def group_axes_by_stage(robot: Robot) -> dict[str, tuple[str, ...]]:
    """Return the axis names by stage, in the robot's order.

    Axes without a stage come last, under the key ``axes``.
    """
    axes_by_stage = {stage: tuple(axes) for stage, axes in robot.stages.items()}
    other_axes = tuple(
        name for name in robot.axes if not any(name in axes for axes in axes_by_stage.values())
    )
    return {**axes_by_stage, "axes": other_axes} if other_axes else axes_by_stage


def make_step_presets(unit: str, span: float) -> tuple[float, ...]:
    """Return jog steps, m or rad: powers of ten times the finest step for the unit.

    The largest is at most a tenth of the range ``span``.
    """
    finest = 1e-6 if unit == "rad" else 1e-8
    decade_count = math.floor(math.log10(span / 10 / finest) + 1e-9)
    return tuple(finest * 10**power for power in range(max(decade_count, 0) + 1))


def describe_speed_changes(before: Record, after: Record) -> str:
    """Return one line per axis with its maximum commanded speed in each of two records."""
    old_speeds, new_speeds = find_max_speeds(before), find_max_speeds(after)
    lines = []
    for axis in old_speeds:
        unit = f"{before.units[axis]}/s"
        scale = choose_scale(unit, max(float(old_speeds[axis]), float(new_speeds[axis])))
        values = (scale.format_value(float(speeds[axis])) for speeds in (old_speeds, new_speeds))
        lines.append(f"{get_axis_label(axis)}: {' → '.join(values)} {scale.symbol}")
    return "\n".join(lines)


def format_duration(seconds: float, decimals: int = 0) -> str:
    """Return a duration in clock format, such as ``1:02:03`` or ``0:07.5``."""
    ticks_per_s = 10**decimals
    # Times are rounded down, so that no time is shown before it is reached.
    ticks = math.floor(seconds * ticks_per_s + 1e-6)
    minutes, remaining_ticks = divmod(ticks, 60 * ticks_per_s)
    hours, minutes = divmod(minutes, 60)
    digits = format_fixed(remaining_ticks / ticks_per_s, decimals).rjust(
        2 + bool(decimals) + decimals, "0"
    )
    return f"{hours}:{minutes:02d}:{digits}" if hours else f"{minutes}:{digits}"


def format_file_size(size: int) -> str:
    """Return a file size with three digits in decimal units (1 kB = 1000 bytes)."""
    amount = float(size)
    for unit in ("bytes", "kB", "MB", "GB"):
        if amount < 999.5:
            return f"{format_rounded(amount, 3)} {unit}"
        amount /= 1000.0
    return f"{format_rounded(amount, 3)} TB"


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        LABELS="AXIS_LABELS",
        axis_scale="choose_axis_scale",
        duration_text="format_duration",
        label="get_axis_label",
        noticeable="find_noticeable_change",
        size_text="format_file_size",
        speed_changes="describe_speed_changes",
        stages="group_axes_by_stage",
        step_presets="make_step_presets",
    )
