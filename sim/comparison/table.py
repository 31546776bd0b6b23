"""The figures of a comparison in words: one line a tap, in units that read well."""

from rotemina.sim.comparison.comparison import Comparison, TapComparison
from rotemina.sim.units import drawing_unit, symbol, to_unit

HEAD = ("tap", "rms", "peak", "of range", "rel. error", "delay", "noise floor", "re-fitted")
NONE = "–"


def table(comparison: Comparison) -> str:
    """Return the figures as aligned text, with a head line."""
    rows = [HEAD, *(cells(tap) for tap in comparison.taps)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEAD))]
    return "\n".join(
        "  ".join(
            cell.ljust(width) if column == 0 else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    )


def cells(tap: TapComparison) -> tuple[str, ...]:
    """Return one text for each of :data:`HEAD`."""
    delay = NONE if tap.delay_s is None else f"{1e3 * tap.delay_s:z.3f} ms"
    return (
        f"{tap.axis}.{tap.tap}",
        _size(tap.rms, tap.unit),
        _size(tap.peak, tap.unit),
        _percent(tap.share_of_range),
        _percent(tap.relative_error),
        delay,
        _size(tap.noise_floor, tap.unit),
        _size(tap.rms_refitted, tap.unit),
    )


def _size(value: float | None, si_unit: str) -> str:
    if value is None:
        return NONE
    unit = drawing_unit(si_unit, value)
    return f"{to_unit(value, unit):.4g} {symbol(unit)}"


def _percent(value: float | None) -> str:
    return NONE if value is None else f"{100.0 * value:.4g} %"
