"""Whether records move an axis in enough different ways to tell effects apart."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Tap

_LEVELS = 2  # positions between which an axis only ever went, that tell too little
_STILL = 1e-3  # of the range of a command, within which positions are one
_LINE = 0.96  # of a command's power, and of its speed's, in a single sine
_TRIED = 41  # frequencies about the strongest line
_KNOTS = 4  # places at most between which size and phase of a sine may change
_ALIKE = 0.95  # correlation from which two axes moved alike
_WIDE = 0.5  # of the axis' range: a sine that goes so far bends what is not straight


def is_poor(evidence: Evidence) -> bool:
    """Tell whether an axis was only ever held, stepped once, or moved a little by one same sine.

    A record in which the axis rests, because another axis is moved, says nothing about its motion.
    """
    commands = [
        (o.record.time_s, o.record.signal(evidence.axis, Tap.CMD)) for o in evidence.observations
    ]
    low, high = min(c.min() for _, c in commands), max(c.max() for _, c in commands)
    if high == low:
        return True
    still = _STILL * (high - low)
    levels = np.unique(np.rint((np.concatenate([c for _, c in commands]) - low) / still))
    if len(levels) <= _LEVELS:
        return True
    if high - low > _WIDE * evidence.robot.axes[evidence.axis].span:
        return False
    sines = [_sine(time_s, c) for time_s, c in commands if np.ptp(c) > still]
    if not sines or any(sine is None for sine in sines):
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
    """Return frequency and size of a command that is one sine, and its speed; else None.

    Size and phase may change slowly, as at a start that swells: no faster than in two periods.
    """
    part = (time_s - time_s[0]) / (time_s[-1] - time_s[0])
    power = np.abs(np.fft.rfft(_centred(command) * np.hanning(len(command))))
    periods = int(np.argmax(power)) + np.linspace(-1.0, 1.0, _TRIED)
    knots = np.linspace(0.0, 1.0, int(np.clip(1 + periods.mean() // 2, 1, _KNOTS)))
    sizes = np.stack([np.interp(part, knots, one) for one in np.eye(len(knots))], axis=1)
    for moved in (command, np.gradient(command, part)):
        left = [_left_by(_waves(sizes, 2.0 * np.pi * count * part), moved) for count in periods]
        if min(left) > 1.0 - _LINE:
            return None
    rate_hz = float(periods[int(np.argmin(left))] / (time_s[-1] - time_s[0]))
    return rate_hz, float(np.std(command))


def _waves(sizes: FloatArray, turns: FloatArray) -> FloatArray:
    """Return a constant and waves of sizes (n, k) along turns (n,): (n, 2 k + 1)."""
    waves = [np.ones((len(turns), 1))]
    waves += [sizes * wave(turns)[:, None] for wave in (np.cos, np.sin)]
    return np.concatenate(waves, axis=1)


def _left_by(basis: FloatArray, signal: FloatArray) -> float:
    """Return the share of the power of a signal (n,) that is left by a basis (n, m)."""
    centred = _centred(signal)
    left = centred - basis @ np.linalg.lstsq(basis.T @ basis, basis.T @ centred)[0]
    return float(left @ left) / float(centred @ centred)
