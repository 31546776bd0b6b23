"""The figures of a comparison as a table with one line per signal, in suitable units."""

from rotemina.sim.comparison.comparison import ModelComparison, TapComparison
from rotemina.sim.comparison.run_comparison import RunComparison
from rotemina.sim.messages import (
    NO_VALUE,
    MessageWording,
    NumberText,
    format_fixed,
    marked,
    message,
)
from rotemina.sim.units import align_columns, format_percent, format_quantity

TABLE_HEAD = (
    marked("engine", "signal"),
    marked("engine", "rms"),
    marked("engine", "peak"),
    marked("engine", "of range"),
    marked("engine", "rel. error"),
    marked("engine", "delay"),
    marked("engine", "noise floor"),
    marked("engine", "re-fitted"),
)


def format_table(comparison: ModelComparison, wording: MessageWording | None = None) -> str:
    """Return the figures as aligned text with a header line, in English by default."""
    wording = wording or MessageWording()
    head = [wording.localize_text("engine", text) for text in TABLE_HEAD]
    return align_columns(
        [head, *([wording.format_field(c) for c in format_cells(tap)] for tap in comparison.taps)]
    )


def format_runs_table(runs: RunComparison, wording: MessageWording | None = None) -> str:
    """Return the figures of two runs as :func:`format_table` does, plus a line on the tip path."""
    if runs.path_rms is None:
        path = message("engine", "tip path: the joints of a tip were not all measured in both runs")
    else:
        path = message("engine", "tip path: {rms} rms, {peak} peak apart").fill(
            rms=format_quantity(runs.path_rms, "m"), peak=format_quantity(runs.path_peak, "m")
        )
    line = (wording or MessageWording()).format_message(path)
    return f"{format_table(runs.comparison, wording)}\n{line}"


def format_cells(tap: TapComparison) -> tuple[str, ...]:
    """Return one text for each column of :data:`TABLE_HEAD`."""
    delay = (
        NO_VALUE if tap.delay_s is None else NumberText(f"{format_fixed(1e3 * tap.delay_s, 3)} ms")
    )
    return (
        f"{tap.axis}.{tap.tap}",
        format_quantity(tap.rms, tap.unit),
        format_quantity(tap.peak, tap.unit),
        format_percent(tap.share_of_range, 4),
        format_percent(tap.relative_error, 4),
        delay,
        format_quantity(tap.noise_floor, tap.unit),
        format_quantity(tap.rms_refitted, tap.unit),
    )
