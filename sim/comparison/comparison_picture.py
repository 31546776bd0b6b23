"""A picture of a comparison: model and real on the left, their difference on the right."""

from pathlib import Path
from typing import BinaryIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.comparison import Comparison, TapComparison
from rotemina.sim.decimation import envelope
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import Scale, percent, scale_of
from rotemina.sim.records.record import Tap
from rotemina.sim.whole_files import replaced

FORMATS = (".svg", ".png", ".pdf")
MODEL_COLOUR, REAL_COLOUR, GAP_COLOUR = "#2f6fb5", "#d1642c", "#5b5b66"
_BUCKETS = 1200
_ROW_INCHES = 2.1


def save_figure(comparison: Comparison, path: Path) -> None:
    """Write the picture, completely or not at all; the name's ending sets its format.

    Raises
    ------
    InputError
        If the ending is none of :data:`FORMATS` or the file cannot be written.
    """
    with replaced(path) as file:
        draw_figure(comparison, file, format_of(path))


def format_of(path: Path) -> str:
    """Return the format that a picture's name asks for: its ending without the dot.

    Raises
    ------
    InputError
        If it is none of :data:`FORMATS`.
    """
    if path.suffix.lower() not in FORMATS:
        raise InputError(
            message("engine", "{path}: the name of a picture must end in {names}").fill(
                path=path, names=", ".join(FORMATS)
            )
        )
    return path.suffix.lower()[1:]


def draw_figure(comparison: Comparison, file: BinaryIO, picture_format: str) -> None:
    """Draw the picture into an open file, as ``svg``, ``png`` or ``pdf``."""
    rows = len(comparison.taps)
    figure = Figure(figsize=(11.0, 0.9 + _ROW_INCHES * rows), layout="constrained")
    grid = figure.subplots(rows, 2, sharex=True, squeeze=False)
    for (signals, gap), tap in zip(grid, comparison.taps, strict=True):
        _draw_row(signals, gap, comparison, tap)
    grid[-1][0].set_xlabel("time [s]")
    grid[-1][1].set_xlabel("time [s]")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=2, frameon=False)
    # A fixed salt and no date: the same comparison gives the same file.
    with mpl.rc_context({"svg.hashsalt": "rotemina", "svg.fonttype": "none"}):
        no_date = _NO_DATE.get(picture_format)
        figure.savefig(file, format=picture_format, dpi=120, metadata=no_date)


_NO_DATE = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


def _draw_row(signals: Axes, gap: Axes, comparison: Comparison, tap: TapComparison) -> None:
    time_s = comparison.record.time_s - comparison.record.time_s[0]
    real = comparison.record.signal(tap.axis, Tap(tap.tap))
    model = comparison.response.signal(tap.axis, Tap(tap.tap))
    scale = scale_of(tap.unit, float(abs(real).max()))
    _line(signals, time_s, scale(real), REAL_COLOUR, "real")
    _line(signals, time_s, scale(model), MODEL_COLOUR, "model")
    signals.set_ylabel(f"{_plain(tap.axis)} {tap.tap} [{scale.symbol}]")
    gap_scale = scale_of(tap.unit, tap.peak)
    _line(gap, time_s, gap_scale(real - model), GAP_COLOUR, "real − model")
    gap.set_ylabel(f"real − model [{gap_scale.symbol}]")
    gap.set_title(_caption(tap, gap_scale), fontsize=9, loc="left")
    for axes in (signals, gap):
        axes.grid(visible=True, linewidth=0.4, alpha=0.6)
        axes.margins(x=0.0)


def _line(axes: Axes, time_s: FloatArray, values: FloatArray, colour: str, label: str) -> None:
    axes.plot(*envelope(time_s, values, _BUCKETS), color=colour, linewidth=0.9, label=label)


def _caption(tap: TapComparison, scale: Scale) -> str:
    text = f"rms {scale.text(tap.rms)}"
    if tap.relative_error is not None:
        text += f" · relative error {percent(tap.relative_error)}"
    if tap.noise_floor is not None:
        text += f" · noise floor {scale.text(tap.noise_floor)}"
    return text


def _plain(name: str) -> str:
    """Keep matplotlib from reading a name as mathematics."""
    return name.replace("$", r"\$")
