"""The gap between a machine and the model in use: one figure, the same wherever it is shown."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.units import drawing_unit, symbol, to_unit

AFTER_S = 0.5  # after a motion, in which what it stirred up dies away
NONE = "–"  # in place of a gap where nothing moved
_ROUNDING_S = 1e-6
_NOTHING = 1e-3  # of the smallest unit, below which nothing is told in digits


@dataclass(frozen=True, slots=True)
class GapFigure:
    """Root mean squares of one axis over what moved, m or rad.

    Attributes
    ----------
    rms : float
        Of measured − model in use, the offset included: *the* gap.
    without_offset : float
        The same about its own mean.
    nominal : float
        Of measured − nominal model, the offset included.
    """

    rms: float
    without_offset: float
    nominal: float


def moving(time_s: FloatArray, command: FloatArray) -> BoolArray:
    """Return which samples (n,) count: the machine moves, or did so in the last 0.5 s.

    Parameters
    ----------
    time_s : (n,)
    command : (n, axes)
        Of all axes: what one of them does may move another.
    """
    if len(time_s) == 0:
        return np.zeros(0, dtype=np.bool_)
    changed = np.zeros(len(time_s), dtype=np.bool_)
    changed[1:] = (np.diff(command, axis=0) != 0.0).any(axis=1)
    changed[:-1] |= changed[1:]  # the sample from which it goes
    latest = np.maximum.accumulate(np.where(changed, time_s, -np.inf))
    return np.asarray(time_s - latest <= AFTER_S + _ROUNDING_S)


def gap_figure(
    counted: BoolArray, measured: FloatArray, model: FloatArray, nominal: FloatArray | None = None
) -> GapFigure | None:
    """Return the gap of one axis over the samples that count; None where there are none.

    Parameters
    ----------
    counted : (n,)
        From :func:`moving`.
    measured, model : (n,)
        The reading, and what the model in use says it is, m or rad. Samples of which one is not
        finite are left out.
    nominal : (n,), optional
        What the nominal model says; without it, that is the model in use.
    """
    nominal = model if nominal is None else nominal
    counted = counted & np.isfinite(measured) & np.isfinite(model) & np.isfinite(nominal)
    if not counted.any():
        return None
    gap = (measured - model)[counted]
    return GapFigure(_rms(gap), float(np.std(gap)), _rms((measured - nominal)[counted]))


def gap_text(size: float | None, si_unit: str) -> str:
    """Return a gap (SI) as every place shows it: three digits, in the unit that suits its size."""
    if size is None or not np.isfinite(size):
        return NONE
    unit = drawing_unit(si_unit, size)
    return f"{_three_digits(float(to_unit(size, unit)))} {symbol(unit)}"


def _three_digits(value: float) -> str:
    """Return a number with three digits that matter, and no exponent."""
    if value < _NOTHING:
        return "0"
    decimals = max(2 - int(np.floor(np.log10(float(f"{value:.2e}")))), 0)
    return f"{value:.{decimals}f}"


def _rms(gap: FloatArray) -> float:
    return float(np.sqrt(np.mean(gap**2)))
