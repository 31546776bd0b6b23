"""The gap between a machine and the model in use: one figure, the same wherever it is shown."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.quantities import NOTHING, scale_of

AFTER_S = 0.5  # after a motion, in which what it stirred up dies away
_ROUNDING_S = 1e-6


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
    """Return the gap of one axis over the counted samples, or None.

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


def gap_course(
    time_s: FloatArray, counted: BoolArray, gap: FloatArray, ends_s: FloatArray, span_s: float
) -> FloatArray:
    """Return the gap (m, axes) over the ``span_s`` up to each of ``ends_s`` (m,).

    Each value is the ``rms`` that :func:`gap_figure` has for the samples of that span; NaN where
    none of them count.

    Parameters
    ----------
    time_s : (n,)
        Increasing.
    counted : (n,)
        From :func:`moving`.
    gap : (n, axes)
        Measured − model in use, m or rad.
    """
    known = counted[:, None] & np.isfinite(gap)
    first = np.searchsorted(time_s, ends_s - span_s, side="left")
    last = np.searchsorted(time_s, ends_s, side="right")
    sums, counts = (
        np.concatenate([np.zeros((1, gap.shape[1])), np.cumsum(values, axis=0)])
        for values in (np.where(known, gap, 0.0) ** 2, known)
    )
    with np.errstate(invalid="ignore"):
        return np.asarray(np.sqrt((sums[last] - sums[first]) / (counts[last] - counts[first])))


def gap_text(size: float | None, si_unit: str) -> str:
    """Return a gap (SI) as every place shows it: three digits, in the unit that suits its size."""
    if size is None or not np.isfinite(size):
        return NOTHING
    return scale_of(si_unit, size, 3)._replace(padded=True).text(size)


def _rms(gap: FloatArray) -> float:
    return float(np.sqrt(np.mean(gap**2)))
