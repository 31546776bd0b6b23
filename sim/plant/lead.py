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
_PERIODS = 20.0  # of its slowest vibration that the way there and back takes
_DECAYS = 15.0  # time constants of that vibration for which it then rests
_LEAST_DECAY = 0.005  # damping ratio that is taken where an axis has less
_ROWS_PER_PERIOD = 8


class Lead(NamedTuple):
    """Times (n,) from 0 on, and by how much each axis is let back at them, (n, axes), m or rad."""

    time_s: FloatArray
    below: FloatArray


def lead_of(axes: Sequence[str], effects: Sequence[Attached]) -> Lead:
    """Return the way to rest of a machine with such effects."""
    held: dict[str, Facts] = {
        one.asked.axis: one.facts
        for one in effects
        if isinstance(one.formulation.acts, Force) and one.facts.stiffness > 0.0
    }
    slowest = min(facts.frequency_hz for facts in held.values())
    decay = min(
        2.0 * np.pi * facts.frequency_hz * max(facts.damping_ratio, _LEAST_DECAY)
        for facts in held.values()
    )
    swing_s = _PERIODS / slowest
    rows = int(np.ceil((swing_s + _DECAYS / decay) * slowest * _ROWS_PER_PERIOD))
    time_s = np.arange(1, rows + 1) / (slowest * _ROWS_PER_PERIOD)
    swing = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.minimum(time_s / swing_s, 1.0))
    depth = np.array([_SHARE * held[name].span if name in held else 0.0 for name in axes])
    return Lead(time_s, np.outer(swing, depth))
