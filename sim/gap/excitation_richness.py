"""Whether records move an axis in enough different ways to tell effects apart."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.records.record import Tap

_LEVELS = 2  # positions between which an axis only ever went, that tell too little
_STILL = 1e-3  # of the range of a command, within which positions are one
_LINE = 0.96  # of a command's power, and of its speed's, in a single sine
_TRIED = 41  # frequencies about the strongest line
_ALIKE = 0.95  # correlation from which two axes moved alike
_WIDE = 0.5  # of the axis' range: a sine that goes so far bends what is not straight


def is_poor(evidence: Evidence) -> bool:
    """Tell whether an axis was only ever held, stepped once, or moved a little by one same sine."""
    commands = [o.record.signal(evidence.axis, Tap.CMD) for o in evidence.observations]
    low, high = min(c.min() for c in commands), max(c.max() for c in commands)
    if high == low:
        return True
    levels = np.unique(np.rint((np.concatenate(commands) - low) / (_STILL * (high - low))))
    if len(levels) <= _LEVELS:
        return True
    if high - low > _WIDE * evidence.robot.axes[evidence.axis].span:
        return False
    sines = [
        _sine(o.record.time_s, c) for o, c in zip(evidence.observations, commands, strict=True)
    ]
    if any(sine is None for sine in sines):
        return False
    rates, sizes = (np.array(values) for values in zip(*(s for s in sines if s), strict=True))
    return bool(np.ptp(rates) < 0.1 * rates.max() and np.ptp(sizes) < 0.1 * sizes.max())


def alike_axes(evidence: Evidence) -> dict[str, float]:
    """Return other axes whose commands were nearly in proportion to the axis' own, with the ratio.

    The axis' own motion over the other's.
    """
    products: dict[str, FloatArray] = {}
    for observation in evidence.observations:
        record = observation.record
        own = _centred(record.signal(evidence.axis, Tap.CMD))
        for axis in record.axes:
            if axis != evidence.axis and record.has(axis, Tap.CMD):
                other = _centred(record.signal(axis, Tap.CMD))
                sums = np.array([own @ other, own @ own, other @ other])
                products[axis] = products.get(axis, np.zeros(3)) + sums
    return {
        axis: float(both / others)
        for axis, (both, own, others) in products.items()
        if others > 0.0 and abs(both) > _ALIKE * np.sqrt(own * others)
    }


def _centred(signal: FloatArray) -> FloatArray:
    return np.asarray(signal - signal.mean())


def _sine(time_s: FloatArray, command: FloatArray) -> tuple[float, float] | None:
    """Return frequency and size of a command that is one sine, and its speed; else None."""
    since_s = time_s - time_s[0]
    power = np.abs(np.fft.rfft(_centred(command) * np.hanning(len(command))))
    rates = (int(np.argmax(power)) + np.linspace(-1.0, 1.0, _TRIED)) / since_s[-1]
    turns, one = 2.0 * np.pi * np.outer(rates, since_s), np.ones(len(command))
    for moved in (command, np.gradient(command, since_s)):
        left = [_left_by(np.stack([one, np.cos(t), np.sin(t)], axis=1), moved) for t in turns]
        if min(left) > 1.0 - _LINE:
            return None
    return float(rates[int(np.argmin(left))]), float(np.std(command))


def _left_by(basis: FloatArray, signal: FloatArray) -> float:
    """Return the share of the power of a signal (n,) that is left by a basis (n, m)."""
    left = signal - basis @ np.linalg.lstsq(basis, signal)[0]
    return float(left @ left) / float(np.sum(_centred(signal) ** 2))
