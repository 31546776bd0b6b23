"""The words of the dry-run table."""

from typing import NamedTuple

from rotemina.app.display import PLAIN_NUMBER, Scale
from rotemina.app.motion.deviation import Gap
from rotemina.app.shell.language import marked, translate
from rotemina.sim.errors import InputError
from rotemina.sim.trajectory.dry_run import AxisFigures
from rotemina.sim.units import from_unit, symbol, to_unit

COLUMNS = (
    marked("trajectory", "lowest"),
    marked("trajectory", "highest"),
    marked("trajectory", "speed"),
    marked("trajectory", "acceleration"),
    marked("trajectory", "predicted error"),
    marked("trajectory", "stop beyond"),
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
    bounds = translate("trajectory", "range {low} … {high}").format(
        low=scale.text(low), high=scale.text(high)
    )
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
    return translate("trajectory", "{rms} rms, {peak} peak").format(
        rms=_small(gap.rms, si_unit, 3), peak=_small(gap.peak, si_unit, 3)
    )


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
            translate(
                "trajectory",
                "{text!r} is no bound: type a number above 0 in {unit}, with a decimal "
                "point, or nothing",
            ).format(text=text, unit=symbol(unit))
        )
    return float(from_unit(float(number), unit))


def _small(value: float, si_unit: str, digits: int) -> str:
    unit = "urad" if si_unit == "rad" else "um"
    return f"{float(to_unit(value, unit)):.{digits}g} {symbol(unit)}"


def _rate(value: float, bound: float | None, si_unit: str, per: str) -> Cell:
    unit = "mrad" if si_unit == "rad" else "mm"
    text = f"{to_unit(value, unit):.4g} {symbol(unit)}{per}"
    if bound is None:
        return Cell(text, translate("trajectory", "no bound is declared in the robot file"))
    share = f"{100 * value / bound:.0f} %"
    return Cell(
        f"{text} · {share}",
        translate("trajectory", "{share} of {bound:g} {unit}{per}").format(
            share=share, bound=to_unit(bound, unit), unit=symbol(unit), per=per
        ),
    )


def _error(axis: AxisFigures) -> Cell:
    if axis.tracking_rms is None or axis.tracking_peak is None:
        return Cell(
            "–", translate("trajectory", "the model gives no prediction for this trajectory")
        )
    unit = "urad" if axis.unit == "rad" else "um"
    rms, peak = (float(to_unit(v, unit)) for v in (axis.tracking_rms, axis.tracking_peak))
    return Cell(
        translate("trajectory", "{rms:.3g} {unit} rms").format(rms=rms, unit=symbol(unit)),
        translate(
            "trajectory", "the model expects up to {peak:.3g} {unit} between command and position"
        ).format(peak=peak, unit=symbol(unit)),
    )
