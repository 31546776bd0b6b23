"""An axis' health card: figures from a record, beside those of the previous card.

A figure counts as changed where both 95 % intervals lie apart.
"""

from collections.abc import Callable
from math import isfinite, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.approaches import find_holds
from rotemina.sim.calibration.sensor_calibration import Figure
from rotemina.sim.errors import InputError
from rotemina.sim.identification.errors import IdentificationError
from rotemina.sim.identification.experiment_signals import signals_of
from rotemina.sim.identification.loop_figures import loops
from rotemina.sim.identification.model import Orders
from rotemina.sim.identification.natural_modes import natural_modes
from rotemina.sim.identification.output_error import identify_oe
from rotemina.sim.messages import joined, message
from rotemina.sim.quantities import fixed
from rotemina.sim.records.record import Record, Tap

PROBABILITY = 0.95
_NORMAL = 1.96
_MOST_ROWS = 60_000
_GOOD_FIT = 80.0  # %: a model below tells nothing of the machine
_LAG_ROWS = 1  # a command is held from its row on, and the sensor is read just before
_NOISES = 4.0  # times the noise: a reading that has settled


class Compared(NamedTuple):
    """A figure, that of the last time, and whether both intervals lie apart."""

    now: Figure
    before: Figure | None
    changed: bool


def card_of(record: Record, axis: str) -> tuple[Figure, ...]:
    """Return the health figures of an axis that a record excites.

    From ``cmd`` to ``meas``: static gain, resonance and damping of a fitted model of second order;
    the width of the loop over its stroke. Of rests after a move: how long the reading takes to stay
    within four times its noise, that noise, and the spread of where a set-point led to when it was
    reached from one side (repeatability).

    Raises
    ------
    IdentificationError
        If the record lacks the pair, or excites none of them.
    """
    for tap in (Tap.CMD, Tap.MEAS):
        if not record.has(axis, tap):
            raise IdentificationError(
                message("engine", "health card: the record has no {axis}.{tap}").fill(
                    axis=axis, tap=tap
                )
            )
    looks: tuple[Callable[[Record, str], list[Figure]], ...] = (_model, _loop, _holds)
    found: list[Figure] = []
    reasons = []
    for look in looks:
        try:
            found += look(record, axis)
        except InputError as error:
            reasons.append(str(error))
    if not found:
        raise IdentificationError(
            message("engine", "health card: the record gives no figure of {axis}: {names}").fill(
                axis=axis, names=joined(reasons, "; ")
            )
        )
    return tuple(found)


def compared_cards(now: tuple[Figure, ...], before: tuple[Figure, ...]) -> tuple[Compared, ...]:
    """Compare a card with an earlier one, figure by figure."""
    known = {(each.name, each.unit): each for each in before}
    found = []
    for new in now:
        old = known.get((new.name, new.unit))
        apart = False
        if old is not None:
            apart = abs(new.value - old.value) > new.half_width + old.half_width
        found.append(Compared(new, old, apart))
    return tuple(found)


def _model(record: Record, axis: str) -> list[Figure]:
    part = record.part(slice(0, _MOST_ROWS))
    signals = signals_of(part, [(axis, Tap.CMD)], [(axis, Tap.MEAS)])
    model = identify_oe(signals, Orders(2, 2, _LAG_ROWS))
    if model.fit_percent < _GOOD_FIT:
        raise IdentificationError(
            message("engine", "a second-order model fits only {fit_percent} %").fill(
                fit_percent=fixed(model.fit_percent, 0)
            )
        )
    gain = model.transfer_function.static_gain
    figures = [Figure("gain", gain, _NORMAL * model.static_gain_deviation, "1")]
    for mode in natural_modes(model)[:1]:
        if mode.oscillates:
            figures += [
                Figure("resonance", mode.frequency_hz, _NORMAL * mode.frequency_deviation, "Hz"),
                Figure("damping", mode.damping_ratio, _NORMAL * mode.damping_deviation, "1"),
            ]
    return [each for each in figures if isfinite(each.value) and isfinite(each.half_width)]


def _loop(record: Record, axis: str) -> list[Figure]:
    command, reading = record.signal(axis, Tap.CMD), record.signal(axis, Tap.MEAS)
    widths = [each.width_percent for each in loops(command, reading, lag_samples=_LAG_ROWS)]
    return _mean("hysteresis width", 0.01 * np.array(widths), "1")


def _holds(record: Record, axis: str) -> list[Figure]:
    command, reading = record.signal(axis, Tap.CMD), record.signal(axis, Tap.MEAS)
    holds = find_holds(record.time_s, command)
    if not len(holds):
        raise IdentificationError(
            message("engine", "{axis}.cmd never rests after a move").fill(axis=axis)
        )
    unit = record.units[axis]
    ends: dict[tuple[float, bool], list[float]] = {}
    noises, settled = [], []
    for begin, end in holds.tolist():
        later = reading[(begin + end) // 2 : end]
        level, way = float(later.mean()), float(command[begin] - command[begin - 1])
        noises.append(float(later.std()))
        ends.setdefault((float(command[begin]), way > 0.0), []).append(level)
        settled.append(_settling_s(record.time_s[begin:end], reading[begin:end], level))
    figures = _mean("settling", np.array(settled), "s")
    figures += _mean("noise rms", np.array(noises), unit)
    return figures + _repeated(ends, unit)


def _settling_s(time_s: FloatArray, reading: FloatArray, level: float) -> float:
    """Return after what time a reading stays within four times its final noise."""
    half = len(reading) // 2
    band = _NOISES * float(reading[half:].std())
    outside = np.flatnonzero(np.abs(reading[:half] - level) > band)
    return float(time_s[outside[-1] + 1] - time_s[0]) if len(outside) else 0.0


def _mean(name: str, values: FloatArray, unit: str) -> list[Figure]:
    """Return the mean of two values or more, with Student's interval."""
    if len(values) < 2:
        return []
    from scipy.stats import t as student  # only here: it takes a third of a second

    quantile = float(student.ppf(0.5 + PROBABILITY / 2.0, len(values) - 1))
    half = quantile * float(values.std(ddof=1)) / sqrt(len(values))
    return [Figure(name, float(values.mean()), half, unit)]


def _repeated(ends: dict[tuple[float, bool], list[float]], unit: str) -> list[Figure]:
    """Return the pooled spread of where a set-point led to from one side, with its interval."""
    often = [np.array(values) for values in ends.values() if len(values) > 1]
    freedom = sum(len(values) - 1 for values in often)
    if freedom < 2:
        return []
    from scipy.stats import chi2  # as above

    spread = sqrt(sum(float(((values - values.mean()) ** 2).sum()) for values in often) / freedom)
    highest = spread * sqrt(freedom / float(chi2.ppf(0.5 - PROBABILITY / 2.0, freedom)))
    return [Figure("repeatability", spread, highest - spread, unit)]
