"""The words of the dry-run table."""

from typing import NamedTuple

from rotemina.app.display import PLAIN_NUMBER, Scale
from rotemina.app.motion.deviation import Gap
from rotemina.sim.errors import InputError
from rotemina.sim.trajectory.dry_run import AxisFigures
from rotemina.sim.units import from_unit, symbol, to_unit

COLUMNS = ("lowest", "highest", "speed", "acceleration", "predicted error", "stop beyond")
BOUND = len(COLUMNS) - 1  # the column that may be edited
_OF_STROKE, _OF_RANGE = 0.25, 0.005  # what is taken for excessive until somebody says otherwise


class Cell(NamedTuple):
    """What a cell shows, and what it says when pointed at."""

    text: str
    tip: str


def cells(axis: AxisFigures, scale: Scale) -> tuple[Cell, ...]:
    """Return one cell for each of :data:`COLUMNS` but the last one, which is the operator's."""
    low, high = axis.bounds.range
    bounds = f"range {scale.text(low)} … {scale.text(high)}"
    return (
        Cell(scale.text(axis.lowest), bounds),
        Cell(scale.text(axis.highest), bounds),
        _rate(axis.peak_speed, axis.bounds.max_speed, axis.unit, "/s"),
        _rate(axis.peak_acceleration, axis.bounds.max_acceleration, axis.unit, "/s²"),
        _error(axis),
    )


def preset_bound(axis: AxisFigures) -> float:
    """Return a deviation of readings from the model, m or rad, that is excessive anywhere."""
    low, high = axis.bounds.range
    return max(_OF_STROKE * (axis.highest - axis.lowest), _OF_RANGE * (high - low))


def bound_text(bound: float | None, si_unit: str) -> str:
    """Return a bound as the table writes it; nothing for none."""
    return "" if bound is None else _small(bound, si_unit, 4)


def gap_text(gap: Gap, si_unit: str) -> str:
    """Return how far model and real are apart."""
    return f"{_small(gap.rms, si_unit, 3)} rms, {_small(gap.peak, si_unit, 3)} peak"


def read_bound(text: str, si_unit: str) -> float | None:
    """Return what somebody typed as a bound, m or rad; None for nothing.

    Raises
    ------
    InputError
        If it is no number above 0.
    """
    unit = "urad" if si_unit == "rad" else "um"
    number = text.replace(symbol(unit), "").strip()
    if not number:
        return None
    if PLAIN_NUMBER.fullmatch(number) is None or float(number) <= 0.0:
        raise InputError(
            f"{text!r} is no bound: type a number above 0 in {symbol(unit)}, with a decimal "
            "point, or nothing"
        )
    return float(from_unit(float(number), unit))


def _small(value: float, si_unit: str, digits: int) -> str:
    unit = "urad" if si_unit == "rad" else "um"
    return f"{float(to_unit(value, unit)):.{digits}g} {symbol(unit)}"


def _rate(value: float, bound: float | None, si_unit: str, per: str) -> Cell:
    unit = "mrad" if si_unit == "rad" else "mm"
    text = f"{to_unit(value, unit):.4g} {symbol(unit)}{per}"
    if bound is None:
        return Cell(text, "no bound is declared in the robot file")
    share = f"{100 * value / bound:.0f} %"
    return Cell(f"{text} · {share}", f"{share} of {to_unit(bound, unit):g} {symbol(unit)}{per}")


def _error(axis: AxisFigures) -> Cell:
    if axis.tracking_rms is None or axis.tracking_peak is None:
        return Cell("–", "the model gives no prediction for this trajectory")
    unit = "urad" if axis.unit == "rad" else "um"
    rms, peak = (float(to_unit(v, unit)) for v in (axis.tracking_rms, axis.tracking_peak))
    return Cell(
        f"{rms:.3g} {symbol(unit)} rms",
        f"the model expects up to {peak:.3g} {symbol(unit)} between command and position",
    )
