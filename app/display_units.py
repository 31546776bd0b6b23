"""How numbers and axis names are displayed: units, digits, labels. Free of Qt."""

import math

from rotemina.sim.quantities import Scale, decimals_of, fixed, rounded, scale_in, scale_of
from rotemina.sim.records.record import Record
from rotemina.sim.records.resampling import induced_velocity
from rotemina.sim.robot.model import Axis, Robot
from rotemina.sim.units import to_unit

LABELS = {"x": "X", "y": "Y", "z": "Z", "thx": "θx", "thy": "θy", "zn": "Z nano"}
_COARSE_M = 1e-3  # a range from here on reads better in mm


def axis_scale(axis: Axis) -> Scale:
    """Choose unit and digits for an axis by its range and its sensor's resolution."""
    if axis.unit == "rad":
        unit = "urad"
    else:
        unit = "mm" if axis.span >= _COARSE_M else "um"
    resolution = axis.sensor.resolution if axis.sensor else 0.0
    resolution = resolution or axis.span / 1e5
    return scale_in(unit, decimals=decimals_of(float(to_unit(resolution, unit))))


def noticeable(axis: Axis) -> float:
    """Return the least difference that noise alone does not make, m or rad.

    Three floors of the sensor, or two steps of it.
    """
    sensor = axis.sensor
    return max(3.0 * sensor.noise_floor, 2.0 * sensor.resolution) if sensor else 0.0


def label(axis: str) -> str:
    """Return an axis' name as operators write it."""
    return LABELS.get(axis, axis)


def stages(robot: Robot) -> dict[str, tuple[str, ...]]:
    """Return the axes by stage, in the robot's order; those in no stage come last."""
    named = {stage: tuple(axes) for stage, axes in robot.stages.items()}
    rest = tuple(name for name in robot.axes if not any(name in axes for axes in named.values()))
    return {**named, "axes": rest} if rest else named


def step_presets(unit: str, span: float) -> tuple[float, ...]:
    """Return jog steps (SI) for an axis unit: decades from fine to a tenth of the range."""
    finest = 1e-6 if unit == "rad" else 1e-8
    decades = math.floor(math.log10(span / 10 / finest) + 1e-9)
    return tuple(finest * 10**power for power in range(max(decades, 0) + 1))


def speed_changes(before: Record, after: Record) -> str:
    """Return one line an axis: its fastest command in one record and in another."""
    old, new = induced_velocity(before), induced_velocity(after)
    lines = []
    for axis in old:
        unit = f"{before.units[axis]}/s"
        scale = scale_of(unit, max(float(old[axis]), float(new[axis])))
        values = (scale.number(float(speeds[axis])) for speeds in (old, new))
        lines.append(f"{label(axis)}: {' → '.join(values)} {scale.symbol}")
    return "\n".join(lines)


def duration_text(seconds: float, decimals: int = 0) -> str:
    """Return a duration as clocks write it, such as ``1:02:03`` or ``0:07.5``."""
    step = 10**decimals
    parts = math.floor(seconds * step + 1e-6)  # a moment that has not come is not shown
    minutes, rest = divmod(parts, 60 * step)
    hours, minutes = divmod(minutes, 60)
    digits = fixed(rest / step, decimals).rjust(2 + bool(decimals) + decimals, "0")
    return f"{hours}:{minutes:02d}:{digits}" if hours else f"{minutes}:{digits}"


def size_text(size: int) -> str:
    """Return an amount of data with three digits, in decimal units as disks are sold."""
    amount = float(size)
    for unit in ("bytes", "kB", "MB", "GB"):
        if amount < 999.5:
            return f"{rounded(amount, 3)} {unit}"
        amount /= 1000.0
    return f"{rounded(amount, 3)} TB"
