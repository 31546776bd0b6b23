"""Assembly of a trajectory from the signals of its axes."""

from collections.abc import Mapping
from math import lcm
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.excitation.axis_draft import MOST_ROWS, Draft, Signal
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap


class Drawn(NamedTuple):
    """One axis' part: the kind of its excitation, the draft and the signal drawn from it."""

    kind: str
    draft: Draft
    signal: Signal


def assembled(parts: Mapping[str, Drawn], rate_hz: float, metadata: Mapping[str, str]) -> Record:
    """Return the trajectory of all axes; one that is done rests until all are.

    Raises
    ------
    ExcitationError
        If it is too long.
    """
    rows = max(len(part.signal.values) for part in parts.values())
    if rows * len(parts) > MOST_ROWS:
        raise ExcitationError(
            message(
                "engine",
                "excitation: {rows} rows of {count} axes are more than {most_rows} values; shorten "
                "it or lower the rate",
            ).fill(rows=rows, count=len(parts), most_rows=MOST_ROWS)
        )
    kinds = ", ".join(dict.fromkeys(part.kind for part in parts.values()))
    return Record.from_signals(
        np.arange(rows) / rate_hz,
        {(name, Tap.CMD): _held(part, rows) for name, part in parts.items()},
        {name: part.draft.unit for name, part in parts.items()},
        {
            "name": f"{kinds} of {', '.join(parts)}",
            "excitation": kinds,
            "rate_hz": repr(rate_hz),
            **metadata,
            **{f"excitation {name}": _words(part) for name, part in parts.items()},
            **_history([part.signal for part in parts.values()], rows),
        },
    )


def _held(part: Drawn, rows: int) -> FloatArray:
    values = part.signal.values
    held = np.pad(values, (0, rows - len(values)), mode="edge")
    # An amplitude may be all the room that there is: rounding must not pass its ends.
    return np.clip(held, part.draft.low, part.draft.high)


def _words(part: Drawn) -> str:
    said = (f"{key} = {_plain(value)}" for key, value in part.signal.parameters.items())
    return "; ".join([part.kind, *said])


def _plain(value: object) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _history(signals: list[Signal], rows: int) -> dict[str, str]:
    periods = [signal.period for signal in signals if signal.period is not None]
    if len(periods) < len(signals) or any(len(signal.values) < rows for signal in signals):
        return {}
    period = lcm(*periods)
    return {} if rows % period else {"history": "periodic", "period_samples": str(period)}
