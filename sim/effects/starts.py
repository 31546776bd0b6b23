"""Start parameters of fits for several effects: in sizes, along a path, at spectral lines."""

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.identification import Starts, Values, View
from rotemina.sim.records.record import Tap

_MOST_PERIODS = 3
_MODES = (0.4, 1.7, 3.0)  # of the axis' own frequency
_MOST_ROWS = 2500  # of a record, that tell a lateness
_PER_RING = 8.0  # latenesses that are tried within a ring of the axis
_MOST_TRIED = 500
_STRETCHED = 0.04  # of the way that is travelled, by which a bend may begin before it


def sizes(**ladders: Sequence[float]) -> Starts:
    """Begin with the first of some parameters that a formulation has, in multiples of its preset.

    Without any of them it begins with the presets.
    """

    def starts(view: View) -> Iterator[Values]:
        name = next((one for one in ladders if one in view.values), None)
        if name is None:
            yield {}
            return
        yield from ({name: view.values[name] * share} for share in ladders[name])

    return starts


def along_the_way(view: View) -> Iterator[Values]:
    """Begin with a bend over the stretch that is travelled, as shares of the range."""
    if "begin" not in view.values:
        yield {}
        return
    least, most = view.extent.reach
    more, facts = _STRETCHED * (most - least), view.facts
    yield {
        "begin": (least - more - facts.low) / facts.span,
        "end": (most + more - facts.low) / facts.span,
    }


def periods(*multiples: float) -> Starts:
    """Begin with multiples of the preset of ``period``, and with the periods that are seen."""

    def starts(view: View) -> Iterator[Values]:
        for share in multiples:
            yield {"period": view.values["period"] * share}
        for seen in view.periods(view.bounds("period"))[:_MOST_PERIODS]:
            yield {"period": seen}

    return starts


def modes(view: View) -> Iterator[Values]:
    """Begin with a mode below and above the axis' own, and with the line that is seen."""
    for share in _MODES:
        yield {"frequency": share * view.facts.pace_hz}
    seen = view.frequency(view.bounds("frequency"))
    if seen is not None:
        yield {"frequency": seen}


def lateness_seen(view: View, latest_s: float) -> float:
    """Return the delay, s, up to ``latest_s``, that removes the most.

    The grid is finer than the ringing of the axis, because the remainder has minima between its
    periods that no fit leaves. The model's own parameters are the original ones: re-tuned ones may
    imitate the delay.
    """
    seen = [
        (record.time_s[::stride], answer[tap][::stride] / record.floor[tap], gap[::stride])
        for record, answer, left in zip(view.records, *view.unbent, strict=True)
        for tap, gap in left.items()
        for stride in (max(len(gap) // _MOST_ROWS, 1),)
        if tap is not Tap.U
    ]
    if not seen:
        return 0.0
    count = min(int(latest_s * view.facts.pace_hz * _PER_RING), _MOST_TRIED)
    tried = np.linspace(0.0, latest_s, count + 1)
    late_s = float(tried[int(np.argmin([_left(seen, one) for one in tried]))])
    above = below = 0.0
    for time_s, answer, gap in seen:
        then = np.interp(time_s - late_s, time_s, answer)
        pace = centred(np.gradient(then, time_s))
        above -= float((gap + centred(answer - then)) @ pace)
        below += float(pace @ pace)
    return late_s + (above / below if below > 0.0 else 0.0)


def _left(seen: Sequence[tuple[FloatArray, FloatArray, FloatArray]], late_s: float) -> float:
    """Return what answers (n,) that come later leave, in the amount that suits best."""
    along = size = 0.0
    for time_s, answer, gap in seen:
        then = centred(np.interp(time_s - late_s, time_s, answer))
        along += float((centred(answer) + gap) @ then)
        size += float(then @ then)
    return -(along**2) / size if size > 0.0 else 0.0


def late(name: str, shares: Sequence[float], late_by_one: Callable[[Values], float]) -> Starts:
    """Start with sizes of a parameter, and with the delay that removes the most.

    ``late_by_one`` gives the delay per second of the parameter, for given other parameters.
    """

    def starts(view: View) -> Iterator[Values]:
        yield from ({name: view.values[name] * share} for share in shares)
        by_one = late_by_one(view.values)
        late_s = lateness_seen(view, by_one * view.bounds(name)[1])
        if late_s > 0.0:
            yield {name: late_s / by_one}

    return starts


def centred(signal: FloatArray) -> FloatArray:
    """Return a signal (n,) without its mean."""
    return np.asarray(signal - signal.mean())


def teeth(view: View, *, at_input: bool) -> Iterator[Values]:
    """Begin with the preset of ``step``, and with the grid whose teeth are seen.

    At the input of a piezo a step is in volts, and counted from the low end of the range.
    """
    facts = view.facts
    low, high = view.bounds("step")
    gain = facts.gain if at_input and facts.kind == "piezo" else 1.0
    yield {"step": view.values["step"]}
    floors = [floor for one in view.records for tap, floor in one.floor.items() if tap is not Tap.U]
    within = max(low * gain, min(floors, default=1e-12)), high * gain
    seen = view.grid(within, facts.low if at_input else 0.0, gain, at_input=at_input)
    if seen is not None:
        yield seen


def regressed(view: View, name: str) -> float:
    """Return the amount of the other axis' command in the remainder, by regression.

    The preset of parameter ``name`` if the data do not determine it; within its bounds.
    """
    above = below = 0.0
    for record in view.records:
        for tap, left in record.left.items():
            if tap is not Tap.U and record.source is not None:
                other = centred(record.source) / record.floor[tap]
                above += float(left @ other)
                below += float(other @ other)
    low, high = view.bounds(name)
    return float(np.clip(above / below, low, high)) if below > 0.0 else view.values[name]


def lag_lateness(values: Mapping[str, float]) -> float:
    """Return how late a lag of up to the third order is: ``(2ζ + r) τ``, τ of the first order."""
    return values["time_constant"] * lag_share(values)


def lag_share(values: Mapping[str, float]) -> float:
    """Return that lateness over the time constant."""
    return 2.0 * values.get("damping_ratio", 0.5) + values.get("ratio", 0.0)
