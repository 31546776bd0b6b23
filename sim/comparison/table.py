"""The figures of a comparison as a table: one line per signal, in units that read well."""

from rotemina.sim.comparison.comparison import Comparison, TapComparison
from rotemina.sim.comparison.run_comparison import RunComparison
from rotemina.sim.messages import Wording, marked, message
from rotemina.sim.quantities import NOTHING, Number, amount, fixed, percent
from rotemina.sim.tables import aligned

HEAD = (
    marked("engine", "signal"),
    marked("engine", "rms"),
    marked("engine", "peak"),
    marked("engine", "of range"),
    marked("engine", "rel. error"),
    marked("engine", "delay"),
    marked("engine", "noise floor"),
    marked("engine", "re-fitted"),
)


def table(comparison: Comparison, wording: Wording | None = None) -> str:
    """Return the figures as aligned text with a head line; in English by default."""
    wording = wording or Wording()
    head = [wording.text("engine", text) for text in HEAD]
    return aligned([head, *([wording.shown(c) for c in cells(tap)] for tap in comparison.taps)])


def runs_table(runs: RunComparison, wording: Wording | None = None) -> str:
    """Return the figures of two runs as :func:`table` does, with a line on the path of the tip."""
    if runs.path_rms is None:
        path = message("engine", "tip path: the joints of a tip were not all measured in both runs")
    else:
        path = message("engine", "tip path: {rms} rms, {peak} peak apart").fill(
            rms=amount(runs.path_rms, "m"), peak=amount(runs.path_peak, "m")
        )
    return f"{table(runs.comparison, wording)}\n{(wording or Wording()).of(path)}"


def cells(tap: TapComparison) -> tuple[str, ...]:
    """Return one text for each of :data:`HEAD`."""
    delay = NOTHING if tap.delay_s is None else Number(f"{fixed(1e3 * tap.delay_s, 3)} ms")
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
