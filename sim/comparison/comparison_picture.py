"""A picture of a comparison: model and real on the left, their difference on the right."""

from pathlib import Path
from typing import BinaryIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rotemina.sim.arrays import FloatArray, decimate_to_envelope
from rotemina.sim.comparison.comparison import ModelComparison, TapComparison
from rotemina.sim.errors import InputError
from rotemina.sim.files import replace_file
from rotemina.sim.records import Tap
from rotemina.sim.units import (
    DisplayScale,
    choose_scale,
    format_percent,
)

PICTURE_FORMATS = (".svg", ".png", ".pdf")
MODEL_COLOUR, REAL_COLOUR, GAP_COLOUR = "#2f6fb5", "#d1642c", "#5b5b66"
_BUCKET_COUNT = 1200
_ROW_INCHES = 2.1


def save_figure(comparison: ModelComparison, path: Path) -> None:
    """Write the picture to a file atomically. The suffix sets the format.

    Raises
    ------
    InputError
        If the suffix is not in :data:`PICTURE_FORMATS` or the file cannot be written.
    """
    with replace_file(path) as file:
        draw_figure(comparison, file, find_picture_format(path))


def find_picture_format(path: Path) -> str:
    """Return the format of a picture file, which is its suffix without the dot.

    Raises
    ------
    InputError
        If the suffix is not in :data:`PICTURE_FORMATS`.
    """
    if path.suffix.lower() not in PICTURE_FORMATS:
        raise InputError(
            "{path}: the name of a picture must end in {names}",
            path=path,
            names=", ".join(PICTURE_FORMATS),
        )
    return path.suffix.lower()[1:]


def draw_figure(comparison: ModelComparison, file: BinaryIO, picture_format: str) -> None:
    """Draw the picture into an open file, as ``svg``, ``png`` or ``pdf``."""
    rows = len(comparison.taps)
    figure = Figure(figsize=(11.0, 0.9 + _ROW_INCHES * rows), layout="constrained")
    grid = figure.subplots(rows, 2, sharex=True, squeeze=False)
    for (signal_axes, gap_axes), tap in zip(grid, comparison.taps, strict=True):
        _draw_row(signal_axes, gap_axes, comparison, tap)
    grid[-1][0].set_xlabel("time [s]")
    grid[-1][1].set_xlabel("time [s]")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=2, frameon=False)
    # The salt is fixed and the date omitted, so that equal comparisons give equal files.
    with mpl.rc_context({"svg.hashsalt": "rotemina", "svg.fonttype": "none"}):
        no_date = _NO_DATE.get(picture_format)
        figure.savefig(file, format=picture_format, dpi=120, metadata=no_date)


_NO_DATE = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


def _draw_row(
    signal_axes: Axes, gap_axes: Axes, comparison: ModelComparison, tap: TapComparison
) -> None:
    time_s = comparison.record.time_s - comparison.record.time_s[0]
    real = comparison.record.signal(tap.axis, Tap(tap.tap))
    model = comparison.response.signal(tap.axis, Tap(tap.tap))
    scale = choose_scale(tap.unit, float(abs(real).max()))
    _draw_line(signal_axes, time_s, scale(real), REAL_COLOUR, "real")
    _draw_line(signal_axes, time_s, scale(model), MODEL_COLOUR, "model")
    signal_axes.set_ylabel(f"{_escape_dollar_signs(tap.axis)} {tap.tap} [{scale.symbol}]")
    gap_scale = choose_scale(tap.unit, tap.peak)
    _draw_line(gap_axes, time_s, gap_scale(real - model), GAP_COLOUR, "real − model")
    gap_axes.set_ylabel(f"real − model [{gap_scale.symbol}]")
    gap_axes.set_title(_make_caption(tap, gap_scale), fontsize=9, loc="left")
    for axes in (signal_axes, gap_axes):
        axes.grid(visible=True, linewidth=0.4, alpha=0.6)
        axes.margins(x=0.0)


def _draw_line(axes: Axes, time_s: FloatArray, values: FloatArray, colour: str, label: str) -> None:
    axes.plot(
        *decimate_to_envelope(time_s, values, _BUCKET_COUNT),
        color=colour,
        linewidth=0.9,
        label=label,
    )


def _make_caption(tap: TapComparison, scale: DisplayScale) -> str:
    text = f"rms {scale.format_with_unit(tap.rms)}"
    if tap.relative_error is not None:
        text += f" · relative error {format_percent(tap.relative_error)}"
    if tap.noise_floor is not None:
        text += f" · noise floor {scale.format_with_unit(tap.noise_floor)}"
    return text


def _escape_dollar_signs(name: str) -> str:
    """Escape dollar signs, because matplotlib would read the text as a formula."""
    return name.replace("$", r"\$")
