"""The words of the dry-run table."""

from typing import NamedTuple

from rotemina.app.display import Scale
from rotemina.sim.trajectory.dry_run import AxisFigures
from rotemina.sim.units import symbol, to_unit

COLUMNS = ("lowest", "highest", "speed", "acceleration", "predicted error")


class Cell(NamedTuple):
    """What a cell shows, and what it says when pointed at."""

    text: str
    tip: str


def cells(axis: AxisFigures, scale: Scale) -> tuple[Cell, ...]:
    """Return one cell for each of :data:`COLUMNS`."""
    low, high = axis.bounds.range
    bounds = f"range {scale.text(low)} … {scale.text(high)}"
    return (
        Cell(scale.text(axis.lowest), bounds),
        Cell(scale.text(axis.highest), bounds),
        _rate(axis.peak_speed, axis.bounds.max_speed, axis.unit, "/s"),
        _rate(axis.peak_acceleration, axis.bounds.max_acceleration, axis.unit, "/s²"),
        _error(axis),
    )


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
