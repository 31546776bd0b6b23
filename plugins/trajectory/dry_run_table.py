"""The words of the dry-run table."""

from typing import NamedTuple

from rotemina.app.motion.model_deviation_watch import Gap
from rotemina.plugins.trajectory import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import Scale, fixed, parsed, scale_in, scale_of
from rotemina.sim.trajectory.dry_run import AxisFigures
from rotemina.sim.units import from_unit, symbol

COLUMNS = (
    mark("lowest"),
    mark("highest"),
    mark("speed"),
    mark("acceleration"),
    mark("predicted error"),
    mark("stop beyond"),
)
BOUND = len(COLUMNS) - 1  # the column that may be edited
_OF_STROKE, _OF_RANGE = 0.25, 0.005  # what is taken for excessive until somebody says otherwise


class Cell(NamedTuple):
    """What a cell shows, and what it says when pointed at."""

    text: str
    tip: str


def cells(axis: AxisFigures, scale: Scale) -> tuple[Cell, ...]:
    """Return one cell for each of :data:`COLUMNS` but the last one, which is the operator's."""
    low, high = axis.bounds.range
    bounds = tr("range {low} … {high}").format(low=scale.text(low), high=scale.text(high))
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
    return tr("{rms} rms, {peak} peak").format(
        rms=_small(gap.rms, si_unit, 3), peak=_small(gap.peak, si_unit, 3)
    )


def read_bound(text: str, si_unit: str) -> float | None:
    """Return what someone typed as a bound, m or rad; None for nothing.

    Raises
    ------
    InputError
        If it is no number above 0.
    """
    unit = "urad" if si_unit == "rad" else "um"
    plain = text.replace(symbol(unit), "").strip()
    if not plain:
        return None
    number = parsed(plain)
    if number is None or number <= 0.0:
        raise InputError(
            tr(
                "{text!r} is not a bound: enter a number above 0 in {unit} with a decimal "
                "point, or leave it empty"
            ).format(text=text, unit=symbol(unit))
        )
    return float(from_unit(number, unit))


def _small(value: float, si_unit: str, digits: int) -> str:
    return scale_in("urad" if si_unit == "rad" else "um", digits=digits).text(value)


def _rate(value: float, bound: float | None, si_unit: str, per: str) -> Cell:
    scale = scale_of(f"{si_unit}{per}", max(value, bound or 0.0))
    text = scale.text(value)
    if bound is None:
        return Cell(text, tr("the robot file states no bound"))
    share = f"{fixed(100.0 * value / bound, 0)} %"
    of_bound = tr("{share} of {bound}")
    return Cell(f"{text} · {share}", of_bound.format(share=share, bound=scale.text(bound)))


def _error(axis: AxisFigures) -> Cell:
    if axis.tracking_rms is None or axis.tracking_peak is None:
        return Cell("–", tr("the model gives no prediction for this trajectory"))
    rms, peak = (_small(each, axis.unit, 3) for each in (axis.tracking_rms, axis.tracking_peak))
    return Cell(
        tr("{rms} rms").format(rms=rms),
        tr("the model predicts up to {peak} between command and position").format(peak=peak),
    )
