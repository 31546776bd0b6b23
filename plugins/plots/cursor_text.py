"""Texts about two cursors: positions, differences, and the inverse of a difference."""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from rotemina.plugins.plots import tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import format_rounded


class PlotKind(StrEnum):
    """Kind of plot: position or gap over time, loop over the command, or spectrum."""

    POSITION = "position"
    GAP = "gap"
    LOOP = "loop"
    SPECTRUM = "spectrum"


class CursorReading(NamedTuple):
    """Text with the values at the cursors: short above a plot, full in its tooltip."""

    short: str
    full: str


def find_nearest_value(x: FloatArray, y: FloatArray, cursor_x: float) -> float | None:
    """Return the y of the sample nearest to the cursor, or None outside of all samples.

    ``x`` and ``y`` are (n,), and ``x`` must increase.
    """
    if len(x) == 0 or not x[0] <= cursor_x <= x[-1]:
        return None
    right = min(int(np.searchsorted(x, cursor_x)), len(x) - 1)
    left = max(right - 1, 0)
    return float(y[left] if cursor_x - x[left] <= x[right] - cursor_x else y[right])


def describe_cursors(kind: PlotKind, a: float, b: float) -> str:
    """Return the times or frequencies of the cursors, which all plots have in common."""
    if kind is PlotKind.LOOP:
        return tr("Cursors: Δx and Δy of each loop appear above it.")
    unit, inverse = ("Hz", "s") if kind is PlotKind.SPECTRUM else ("s", "Hz")
    difference = b - a
    first, second, delta = (f"{format_rounded(value)} {unit}" for value in (a, b, difference))
    text = f"A {first}  B {second}  Δ {delta}"
    return (
        text if difference == 0.0 else f"{text}  1/Δ {format_rounded(1.0 / difference)} {inverse}"
    )


def describe_values(a: float | None, b: float | None, unit: str) -> CursorReading:
    """Return the values of a signal at the cursors, and their difference."""
    if a is None or b is None:
        return CursorReading(tr("cursor outside"), tr("a cursor is outside the measured samples"))
    short = f"Δ {format_rounded(b - a)} {unit}"
    return CursorReading(
        short, f"A {format_rounded(a, 7)} {unit}, B {format_rounded(b, 7)} {unit}, {short}"
    )


def describe_loop(a: tuple[float, float], b: tuple[float, float], unit: str) -> CursorReading:
    """Return the differences between two points of a loop, and their ratio."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    short = f"Δx {format_rounded(dx)}  Δy {format_rounded(dy)} {unit}"
    return CursorReading(short, short if dx == 0.0 else f"{short}, Δy/Δx {format_rounded(dy / dx)}")
