"""Texts of the dry-run table."""

from typing import NamedTuple

from rotemina.app.motion.model import PlaybackGap
from rotemina.plugins.trajectory import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed, parse_number
from rotemina.sim.trajectory import AxisDemands
from rotemina.sim.units import (
    DisplayScale,
    choose_scale,
    display_symbol_of,
    from_unit,
    make_scale,
)

COLUMN_TITLES = (
    mark("lowest"),
    mark("highest"),
    mark("speed"),
    mark("acceleration"),
    mark("predicted error"),
    mark("stop beyond"),
)
# The only column that the operator can edit.
BOUND_COLUMN = len(COLUMN_TITLES) - 1
# The default bound is the larger of these ratios times the stroke and the range of the axis.
_DEFAULT_BOUND_TO_STROKE_RATIO, _DEFAULT_BOUND_TO_RANGE_RATIO = 0.25, 0.005


class DryRunCell(NamedTuple):
    """Text and tooltip of a cell."""

    text: str
    tip: str


def make_cells(axis: AxisDemands, scale: DisplayScale) -> tuple[DryRunCell, ...]:
    """Return the cells of a row, except for the last column, which the operator edits."""
    low, high = axis.bounds.range
    bounds = tr("range {low} … {high}").format(
        low=scale.format_with_unit(low), high=scale.format_with_unit(high)
    )
    return (
        DryRunCell(scale.format_with_unit(axis.lowest), bounds),
        DryRunCell(scale.format_with_unit(axis.highest), bounds),
        _make_rate_cell(axis.peak_speed, axis.bounds.max_speed, axis.unit, "/s"),
        _make_rate_cell(axis.peak_acceleration, axis.bounds.max_acceleration, axis.unit, "/s²"),
        _make_error_cell(axis),
    )


def compute_default_bound(axis: AxisDemands) -> float:
    """Return the default bound on the deviation of readings from the model, m or rad.

    A larger deviation is excessive on any machine.
    """
    low, high = axis.bounds.range
    return max(
        _DEFAULT_BOUND_TO_STROKE_RATIO * (axis.highest - axis.lowest),
        _DEFAULT_BOUND_TO_RANGE_RATIO * (high - low),
    )


def format_bound(bound: float | None, si_unit: str) -> str:
    """Return a bound as text for the table; empty for None."""
    return "" if bound is None else _format_micro(bound, si_unit, 4)


def format_model_gap(gap: PlaybackGap, si_unit: str) -> str:
    """Return the gap between model and machine as text."""
    return tr("{rms} rms, {peak} peak").format(
        rms=_format_micro(gap.rms, si_unit, 3), peak=_format_micro(gap.peak, si_unit, 3)
    )


def parse_bound(text: str, si_unit: str) -> float | None:
    """Return the bound (m or rad) in a typed text, or None for an empty text.

    Raises
    ------
    InputError
        If the text is not a number above 0.
    """
    unit = "urad" if si_unit == "rad" else "um"
    number_text = text.replace(display_symbol_of(unit), "").strip()
    if not number_text:
        return None
    number = parse_number(number_text)
    if number is None or number <= 0.0:
        raise InputError(
            tr(
                "{text!r} is not a bound: enter a number above 0 in {unit} with a decimal "
                "point, or leave it empty"
            ).format(text=text, unit=display_symbol_of(unit))
        )
    return float(from_unit(number, unit))


def _format_micro(value: float, si_unit: str, digits: int) -> str:
    return make_scale("urad" if si_unit == "rad" else "um", digits=digits).format_with_unit(value)


def _make_rate_cell(
    value: float, bound: float | None, si_unit: str, unit_suffix: str
) -> DryRunCell:
    scale = choose_scale(f"{si_unit}{unit_suffix}", max(value, bound or 0.0))
    text = scale.format_with_unit(value)
    if bound is None:
        return DryRunCell(text, tr("the robot file states no bound"))
    percentage = f"{format_fixed(100.0 * value / bound, 0)} %"
    tooltip = tr("{share} of {bound}").format(share=percentage, bound=scale.format_with_unit(bound))
    return DryRunCell(f"{text} · {percentage}", tooltip)


def _make_error_cell(axis: AxisDemands) -> DryRunCell:
    if axis.tracking_rms is None or axis.tracking_peak is None:
        return DryRunCell("–", tr("the model gives no prediction for this trajectory"))
    rms, peak = (
        _format_micro(value, axis.unit, 3) for value in (axis.tracking_rms, axis.tracking_peak)
    )
    return DryRunCell(
        tr("{rms} rms").format(rms=rms),
        tr("the model predicts up to {peak} between command and position").format(peak=peak),
    )
