"""The gap between a machine and the model in use, as one figure for the whole program."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import NO_VALUE
from rotemina.sim.units import choose_scale

# Oscillations decay within this time after a motion.
SETTLING_S = 0.5
# Times that differ by less than this count as equal.
_ROUNDING_S = 1e-6


@dataclass(frozen=True, slots=True)
class GapFigure:
    """Rms gap of one axis over the samples in motion, m or rad.

    Attributes
    ----------
    rms : float
        Rms of measured − model in use, including the offset. This is *the* gap.
    without_offset : float
        The same, after its mean is removed.
    nominal : float
        Rms of measured − nominal model, including the offset.
    """

    rms: float
    without_offset: float
    nominal: float


def find_moving_samples(time_s: FloatArray, command: FloatArray) -> BoolArray:
    """Return which samples (n,) count: those in motion, and those within 0.5 s after a motion.

    Parameters
    ----------
    time_s : (n,)
    command : (n, axes)
        Commands of all axes, because the motion of one axis may move another one.
    """
    if len(time_s) == 0:
        return np.zeros(0, dtype=np.bool_)
    changed = np.zeros(len(time_s), dtype=np.bool_)
    changed[1:] = (np.diff(command, axis=0) != 0.0).any(axis=1)
    # The sample before a change counts too, because the motion starts there.
    changed[:-1] |= changed[1:]
    last_change_s = np.maximum.accumulate(np.where(changed, time_s, -np.inf))
    return np.asarray(time_s - last_change_s <= SETTLING_S + _ROUNDING_S)


def compute_gap_figure(
    is_counted: BoolArray,
    measured: FloatArray,
    model: FloatArray,
    nominal: FloatArray | None = None,
) -> GapFigure | None:
    """Return the gap of one axis over the counted samples, or None if there are none.

    Parameters
    ----------
    counted : (n,)
        From :func:`find_moving_samples`.
    measured, model : (n,)
        The reading, and its prediction by the model in use, m or rad. Samples in which either is
        not finite are ignored.
    nominal : (n,), optional
        Prediction of the nominal model; by default, the model in use is the nominal one.
    """
    nominal = model if nominal is None else nominal
    is_counted = is_counted & np.isfinite(measured) & np.isfinite(model) & np.isfinite(nominal)
    if not is_counted.any():
        return None
    gap = (measured - model)[is_counted]
    return GapFigure(
        _compute_rms(gap), float(np.std(gap)), _compute_rms((measured - nominal)[is_counted])
    )


def compute_gap_course(
    time_s: FloatArray, counted: BoolArray, gap: FloatArray, ends_s: FloatArray, span_s: float
) -> FloatArray:
    """Return the gap (m, axes) over the ``span_s`` before each of ``ends_s`` (m,).

    Each value is the ``rms`` of :func:`compute_gap_figure` for the samples of that span. It is NaN
    if none of them counts.

    Parameters
    ----------
    time_s : (n,)
        Increasing times.
    counted : (n,)
        From :func:`find_moving_samples`.
    gap : (n, axes)
        Measured − model in use, m or rad.
    """
    is_known = counted[:, None] & np.isfinite(gap)
    first = np.searchsorted(time_s, ends_s - span_s, side="left")
    last = np.searchsorted(time_s, ends_s, side="right")
    sums, counts = (
        np.concatenate([np.zeros((1, gap.shape[1])), np.cumsum(values, axis=0)])
        for values in (np.where(is_known, gap, 0.0) ** 2, is_known)
    )
    with np.errstate(invalid="ignore"):
        return np.asarray(np.sqrt((sums[last] - sums[first]) / (counts[last] - counts[first])))


def format_gap(size: float | None, si_unit: str) -> str:
    """Return a gap (SI) as text with three digits, in the unit that suits its size."""
    if size is None or not np.isfinite(size):
        return NO_VALUE
    return choose_scale(si_unit, size, 3)._replace(padded=True).format_with_unit(size)


def _compute_rms(gap: FloatArray) -> float:
    return float(np.sqrt(np.mean(gap**2)))
