"""Ready-made starts of fits: from sizes, along the travel, at spectral lines, from delays."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.effects.identification import FitView, Starts, Values
from rotemina.sim.records import Tap

_MAX_PERIOD_COUNT = 3
# Frequencies at which a fit looks for a mode, relative to the natural frequency of the axis.
_START_FREQUENCY_RATIOS = (0.4, 1.7, 3.0)
# Enough rows of a record to estimate a delay.
_MAX_ROWS_PER_RECORD = 2500
# Delays that are tried within one period of the axis.
_DELAYS_PER_PERIOD = 8.0
_MAX_DELAY_COUNT = 500
# Excess of a curved section over the travel at each end, relative to the travel.
_TRAVEL_MARGIN_RATIO = 0.04


def start_from_sizes(**factors: Sequence[float]) -> Starts:
    """Start from several sizes of one parameter. ``factors`` are multiples of its preset.

    The parameter is the first name in ``factors`` that the formulation has. If it has none of them,
    the fit starts from the presets.
    """

    def starts(view: FitView) -> Iterator[Values]:
        name = next((key for key in factors if key in view.values), None)
        if name is None:
            yield {}
            return
        yield from ({name: view.values[name] * multiple} for multiple in factors[name])

    return starts


def start_along_travel(view: FitView) -> Iterator[Values]:
    """Start with a curved section over the travel of the records, relative to the range."""
    if "begin" not in view.values:
        yield {}
        return
    lowest, highest = view.extent.reach
    margin, facts = _TRAVEL_MARGIN_RATIO * (highest - lowest), view.facts
    yield {
        "begin": (lowest - margin - facts.low) / facts.span,
        "end": (highest + margin - facts.low) / facts.span,
    }


def start_from_periods(*multiples: float) -> Starts:
    """Start from multiples of the preset of ``period``, and from the strongest observed periods."""

    def starts(view: FitView) -> Iterator[Values]:
        for factor in multiples:
            yield {"period": view.values["period"] * factor}
        for period in view.periods(view.bounds("period"))[:_MAX_PERIOD_COUNT]:
            yield {"period": period}

    return starts


def start_from_modes(view: FitView) -> Iterator[Values]:
    """Start from modes below and above that of the axis, and from the strongest line."""
    for ratio in _START_FREQUENCY_RATIOS:
        yield {"frequency": ratio * view.facts.pace_hz}
    frequency = view.frequency(view.bounds("frequency"))
    if frequency is not None:
        yield {"frequency": frequency}


def estimate_delay(view: FitView, latest_s: float) -> float:
    """Return the delay, s, up to ``latest_s``, that removes most of the remainder.

    The grid of delays is finer than the ringing of the axis, because the remainder has local minima
    one period apart from which no fit escapes. The responses belong to the model's original
    parameters, because re-tuned parameters may imitate the delay.
    """
    signals = [
        (record.time_s[::stride], response[tap][::stride] / record.floor[tap], remainder[::stride])
        for record, response, remainders in zip(view.records, *view.untuned, strict=True)
        for tap, remainder in remainders.items()
        for stride in (max(len(remainder) // _MAX_ROWS_PER_RECORD, 1),)
        if tap is not Tap.U
    ]
    if not signals:
        return 0.0
    delay_count = min(int(latest_s * view.facts.pace_hz * _DELAYS_PER_PERIOD), _MAX_DELAY_COUNT)
    delays_s = np.linspace(0.0, latest_s, delay_count + 1)
    delay_s = float(
        delays_s[
            int(
                np.argmin(
                    [_compute_remainder_change(signals, candidate_s) for candidate_s in delays_s]
                )
            )
        ]
    )
    # One linear step refines the delay between the points of the grid.
    numerator = denominator = 0.0
    for time_s, response, remainder in signals:
        delayed = np.interp(time_s - delay_s, time_s, response)
        slope = remove_mean(np.gradient(delayed, time_s))
        numerator -= float((remainder + remove_mean(response - delayed)) @ slope)
        denominator += float(slope @ slope)
    return delay_s + (numerator / denominator if denominator > 0.0 else 0.0)


def _compute_remainder_change(
    signals: Sequence[tuple[FloatArray, FloatArray, FloatArray]], delay_s: float
) -> float:
    """Return the change of the squared remainder if the responses are delayed by ``delay_s``.

    Each item of ``signals`` is (time, response, remainder), each (n,). The delayed responses are
    scaled by the factor that reduces the remainder most.
    """
    projection = energy = 0.0
    for time_s, response, remainder in signals:
        delayed = remove_mean(np.interp(time_s - delay_s, time_s, response))
        projection += float((remove_mean(response) + remainder) @ delayed)
        energy += float(delayed @ delayed)
    return -(projection**2) / energy if energy > 0.0 else 0.0


def start_from_delays(
    name: str, shares: Sequence[float], delay_per_unit: Callable[[Values], float]
) -> Starts:
    """Start from several sizes of a parameter, and from the estimated delay.

    ``delay_per_unit`` returns the delay per unit of the parameter, for given other parameters.
    """

    def starts(view: FitView) -> Iterator[Values]:
        yield from ({name: view.values[name] * factor} for factor in shares)
        delay_of_unit = delay_per_unit(view.values)
        delay_s = estimate_delay(view, delay_of_unit * view.bounds(name)[1])
        if delay_s > 0.0:
            yield {name: delay_s / delay_of_unit}

    return starts


def remove_mean(signal: FloatArray) -> FloatArray:
    """Return a signal (n,) without its mean."""
    return np.asarray(signal - signal.mean())


def start_from_grid(view: FitView, *, at_input: bool) -> Iterator[Values]:
    """Start from the preset of ``step``, and from the quantization grid found in the records.

    At the input of a piezo, the step is in volts and counted from the low end of the range.
    """
    facts = view.facts
    low, high = view.bounds("step")
    gain = facts.gain if at_input and facts.kind == "piezo" else 1.0
    yield {"step": view.values["step"]}
    floors = [
        floor for record in view.records for tap, floor in record.floor.items() if tap is not Tap.U
    ]
    step_range = max(low * gain, min(floors, default=1e-12)), high * gain
    grid = view.grid(step_range, facts.low if at_input else 0.0, gain, at_input=at_input)
    if grid is not None:
        yield grid


def regress_other_command(view: FitView, name: str) -> float:
    """Return the coefficient of the other axis' command in the remainder, by linear regression.

    It is clipped to the bounds of the parameter ``name``. If the data do not determine it, the
    preset is returned.
    """
    numerator = denominator = 0.0
    for record in view.records:
        for tap, remainder in record.remainder.items():
            if tap is not Tap.U and record.source is not None:
                other = remove_mean(record.source) / record.floor[tap]
                numerator += float(remainder @ other)
                denominator += float(other @ other)
    low, high = view.bounds(name)
    return (
        float(np.clip(numerator / denominator, low, high))
        if denominator > 0.0
        else view.values[name]
    )


def compute_lag_delay(values: Mapping[str, float]) -> float:
    """Return the delay of a lag of up to third order, ``(2ζ + r) τ``, or τ for first order."""
    return values["time_constant"] * compute_lag_delay_ratio(values)


def compute_lag_delay_ratio(values: Mapping[str, float]) -> float:
    """Return the delay of the lag over its time constant."""
    return 2.0 * values.get("damping_ratio", 0.5) + values.get("ratio", 0.0)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        along_the_way="start_along_travel",
        centred="remove_mean",
        lag_lateness="compute_lag_delay",
        lag_share="compute_lag_delay_ratio",
        late="start_from_delays",
        lateness_seen="estimate_delay",
        modes="start_from_modes",
        periods="start_from_periods",
        regressed="regress_other_command",
        sizes="start_from_sizes",
        teeth="start_from_grid",
    )
