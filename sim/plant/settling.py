"""How a machine under the forces of effects is brought to rest before a run.

Rest under dry friction depends on how it was reached. By convention a run begins as after a rise
from below, long ago: so the axes are let back a little, and brought up again, before it.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Force

_SHARE = 0.002  # of the range, by which an axis is let back
_PERIODS = 10.0  # of its slowest vibration that the way back takes
_DECAYS = 20.0  # time constants of that vibration that the way up takes
_LEAST_DECAY = 0.005  # damping ratio that is taken where an axis has less
_ROWS_PER_PERIOD = 8


class Lead(NamedTuple):
    """Times (n,) from 0 on, and by how much each axis is let back at them, (n, axes), m or rad."""

    time_s: FloatArray
    below: FloatArray


def is_led(facts: Facts) -> bool:
    """Return whether an axis comes to rest under its input; one moved by a force is put there."""
    return facts.stiffness > 0.0 and facts.kind != "force"


def lead_of(axes: Sequence[str], effects: Sequence[Attached]) -> Lead:
    """Return the path to rest of a machine with such effects.

    The way up is ``(1 + t/τ) exp(−t/τ)`` with the time constant τ of the slowest vibration, so
    the axis never runs ahead of its input: ``M |ẍ| < D |ẋ|``. It slides until it stands, and dry
    friction ends where it does after an infinitely slow rise. What is left at the end is taken
    off evenly.
    """
    held: dict[str, Facts] = {
        one.asked.axis: one.facts
        for one in effects
        if isinstance(one.formulation.acts, Force) and is_led(one.facts)
    }
    slowest = min(facts.frequency_hz for facts in held.values())
    decay = min(
        2.0 * np.pi * facts.frequency_hz * max(facts.damping_ratio, _LEAST_DECAY)
        for facts in held.values()
    )
    back_s = _PERIODS / slowest
    rows = int(np.ceil((back_s + _DECAYS / decay) * slowest * _ROWS_PER_PERIOD))
    time_s = np.arange(1, rows + 1) / (slowest * _ROWS_PER_PERIOD)
    back = 0.5 - 0.5 * np.cos(np.pi * np.minimum(time_s / back_s, 1.0))
    since = np.maximum(time_s - back_s, 0.0) * decay
    rise = (1.0 + since) * np.exp(-since)
    rise -= rise[-1] * since / since[-1]
    depth = np.array([_SHARE * held[name].span if name in held else 0.0 for name in axes])
    return Lead(time_s, np.outer(back * rise, depth))
