"""Assembly of a trajectory from the signals of its axes."""

from collections.abc import Mapping
from math import lcm
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.axis_draft import MAX_ROWS, AxisDraft, AxisSignal
from rotemina.sim.records import Record, Tap


class AxisExcitation(NamedTuple):
    """The excitation of one axis: its kind, the draft, and the signal drawn from it."""

    kind: str
    draft: AxisDraft
    signal: AxisSignal


def assemble_trajectory(
    parts: Mapping[str, AxisExcitation], rate_hz: float, metadata: Mapping[str, str]
) -> Record:
    """Return the trajectory of all axes. Axes that finish early rest until the end.

    Raises
    ------
    ExcitationRequestError
        If the trajectory has too many rows.
    """
    rows = max(len(part.signal.values) for part in parts.values())
    if rows * len(parts) > MAX_ROWS:
        raise ExcitationRequestError(
            "excitation: {rows} rows of {count} axes are more than {most_rows} values; shorten "
            "it or lower the rate",
            rows=rows,
            count=len(parts),
            most_rows=MAX_ROWS,
        )
    kinds = ", ".join(dict.fromkeys(part.kind for part in parts.values()))
    return Record.from_signals(
        np.arange(rows) / rate_hz,
        {(name, Tap.CMD): _hold_end(part, rows) for name, part in parts.items()},
        {name: part.draft.unit for name, part in parts.items()},
        {
            "name": f"{kinds} of {', '.join(parts)}",
            "excitation": kinds,
            "rate_hz": repr(rate_hz),
            **metadata,
            **{f"excitation {name}": _describe_part(part) for name, part in parts.items()},
            **_make_history([part.signal for part in parts.values()], rows),
        },
    )


def _hold_end(part: AxisExcitation, rows: int) -> FloatArray:
    values = part.signal.values
    extended = np.pad(values, (0, rows - len(values)), mode="edge")
    # If the motion uses the whole range, rounding could exceed the ends of the range.
    return np.clip(extended, part.draft.low, part.draft.high)


def _describe_part(part: AxisExcitation) -> str:
    parameters = (
        f"{key} = {_format_value(value)}" for key, value in part.signal.parameters.items()
    )
    return "; ".join([part.kind, *parameters])


def _format_value(value: object) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _make_history(signals: list[AxisSignal], rows: int) -> dict[str, str]:
    periods = [signal.period for signal in signals if signal.period is not None]
    if len(periods) < len(signals) or any(len(signal.values) < rows for signal in signals):
        return {}
    period = lcm(*periods)
    return {} if rows % period else {"history": "periodic", "period_samples": str(period)}
