"""Values of two cursors: positions, differences, and their inverse."""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from rotemina.plugins.plots import tr
from rotemina.sim.arrays import FloatArray
from rotemina.sim.quantities import rounded


class Shown(StrEnum):
    """What the plots draw."""

    POSITION = "position"
    GAP = "gap"
    LOOP = "loop"
    SPECTRUM = "spectrum"


class Reading(NamedTuple):
    """What cursors say above a plot, and all of it in the tooltip."""

    short: str
    full: str


def nearest(x: FloatArray, y: FloatArray, at: float) -> float | None:
    """Return the value of the sample that is nearest to a place; x (n,) increases."""
    if len(x) == 0 or not x[0] <= at <= x[-1]:
        return None
    right = min(int(np.searchsorted(x, at)), len(x) - 1)
    left = max(right - 1, 0)
    return float(y[left] if at - x[left] <= x[right] - at else y[right])


def across_text(shown: Shown, a: float, b: float) -> str:
    """Return what the cursors say of time or frequency, for all plots together."""
    if shown is Shown.LOOP:
        return tr("Cursors: Δx and Δy of each loop appear above it.")
    unit, inverse = ("Hz", "s") if shown is Shown.SPECTRUM else ("s", "Hz")
    difference = b - a
    text = f"A {rounded(a)} {unit}  B {rounded(b)} {unit}  Δ {rounded(difference)} {unit}"
    return text if difference == 0.0 else f"{text}  1/Δ {rounded(1.0 / difference)} {inverse}"


def values_text(a: float | None, b: float | None, unit: str) -> Reading:
    """Return what a signal has at the cursors, and the difference."""
    if a is None or b is None:
        return Reading(tr("cursor outside"), tr("a cursor is where nothing was measured"))
    short = f"Δ {rounded(b - a)} {unit}"
    return Reading(short, f"A {rounded(a, 7)} {unit}, B {rounded(b, 7)} {unit}, {short}")


def loop_text(a: tuple[float, float], b: tuple[float, float], unit: str) -> Reading:
    """Return the differences of two points of a loop, and their ratio."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    short = f"Δx {rounded(dx)}  Δy {rounded(dy)} {unit}"
    return Reading(short, short if dx == 0.0 else f"{short}, Δy/Δx {rounded(dy / dx)}")
