"""The gap as text, with the same name and number of digits wherever it is shown."""

from rotemina.app.language import get_axis_label, marked, translate
from rotemina.app.motion.playback import ComparedRun
from rotemina.sim.comparison import GapFigure, format_gap
from rotemina.sim.messages import NO_VALUE
from rotemina.sim.records import Tap

LIVE_GAP_LABEL = marked("shell", "Gap, last 10 s")
RUN_GAP_LABEL = marked("shell", "Gap, this run")
# Time span of the live gap.
LIVE_GAP_WINDOW_S = 10.0


def format_live_gap(figure: GapFigure | None, unit: str) -> str:
    """Return the gap of the last 10 s with its name."""
    return f"{translate('shell', LIVE_GAP_LABEL)} {format_gap_size(figure, unit)}"


def format_run_gap(figure: GapFigure | None, unit: str) -> str:
    """Return the gap of the loaded run with its name."""
    return f"{translate('shell', RUN_GAP_LABEL)} {format_gap_size(figure, unit)}"


def format_gap_size(figure: GapFigure | None, unit: str) -> str:
    """Return the value of a gap with its unit."""
    return NO_VALUE if figure is None else format_gap(figure.rms, unit)


def format_gap_details(figure: GapFigure | None, unit: str) -> str:
    """Return the details of a gap: without offset, and relative to the nominal model."""
    if figure is None:
        return translate("shell", "no motion")
    text = translate("shell", "without offset {without} · nominal {nominal}")
    return text.format(
        without=format_gap(figure.without_offset, unit), nominal=format_gap(figure.nominal, unit)
    )


def format_run_gaps(run: ComparedRun) -> list[str]:
    """Return one line with the gap for each axis of a run."""
    measured_gaps = [
        (axis, figure) for (axis, tap), figure in run.gaps.items() if tap is Tap.MEAS and figure
    ]
    return [
        f"{get_axis_label(axis)}: {format_run_gap(figure, run.record.units[axis])} "
        f"({format_gap_details(figure, run.record.units[axis])})"
        for axis, figure in measured_gaps
    ]
