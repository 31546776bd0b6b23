"""The gap in words: the same name and the same digits wherever it is shown."""

from rotemina.app.display_units import label
from rotemina.app.motion.compared_run import Run
from rotemina.app.shell.language import marked, translate
from rotemina.sim.comparison.gap import GapFigure, gap_text
from rotemina.sim.quantities import NOTHING
from rotemina.sim.records.record import Tap

LIVE = marked("shell", "Gap, last 10 s")
RUN = marked("shell", "Gap, this run")
LIVE_S = 10.0  # how long back the live gap looks


def live_gap(figure: GapFigure | None, unit: str) -> str:
    """Return the gap of the last 10 s, with its name."""
    return f"{translate('shell', LIVE)} {size(figure, unit)}"


def run_gap(figure: GapFigure | None, unit: str) -> str:
    """Return the gap of the run in hand, with its name."""
    return f"{translate('shell', RUN)} {size(figure, unit)}"


def size(figure: GapFigure | None, unit: str) -> str:
    """Return a gap alone, with its unit."""
    return NOTHING if figure is None else gap_text(figure.rms, unit)


def small_print(figure: GapFigure | None, unit: str) -> str:
    """Return what stands beside a gap: it without its offset, and that of the nominal model."""
    if figure is None:
        return translate("shell", "no motion")
    text = translate("shell", "without offset {without} · nominal {nominal}")
    return text.format(
        without=gap_text(figure.without_offset, unit), nominal=gap_text(figure.nominal, unit)
    )


def run_lines(run: Run) -> list[str]:
    """Return the gap of each axis of a run, one line each."""
    found = [
        (axis, figure) for (axis, tap), figure in run.gaps.items() if tap is Tap.MEAS and figure
    ]
    return [
        f"{label(axis)}: {run_gap(figure, run.record.units[axis])} "
        f"({small_print(figure, run.record.units[axis])})"
        for axis, figure in found
    ]
