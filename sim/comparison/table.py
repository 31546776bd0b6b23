"""The figures of a comparison in words: one line a tap, in units that read well."""

from rotemina.sim.comparison.comparison import Comparison, TapComparison
from rotemina.sim.comparison.runs import RunComparison
from rotemina.sim.quantities import NOTHING, amount, fixed, percent

HEAD = ("tap", "rms", "peak", "of range", "rel. error", "delay", "noise floor", "re-fitted")


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


def runs_table(runs: RunComparison) -> str:
    """Return the figures of two runs as :func:`table` does, with a line on the tip's path."""
    path = (
        f"tip path: {amount(runs.path_rms, 'm')} rms, {amount(runs.path_peak, 'm')} peak apart"
        if runs.path_rms is not None
        else "tip path: not all joints of a tip were measured in both runs"
    )
    return f"{table(runs.comparison)}\n{path}"


def cells(tap: TapComparison) -> tuple[str, ...]:
    """Return one text for each of :data:`HEAD`."""
    delay = NOTHING if tap.delay_s is None else f"{fixed(1e3 * tap.delay_s, 3)} ms"
    return (
        f"{tap.axis}.{tap.tap}",
        amount(tap.rms, tap.unit),
        amount(tap.peak, tap.unit),
        percent(tap.share_of_range, 4),
        percent(tap.relative_error, 4),
        delay,
        amount(tap.noise_floor, tap.unit),
        amount(tap.rms_refitted, tap.unit),
    )
