"""Path to rest before a run, for a machine with effects that are forces.

Under dry friction, the rest position depends on how it was reached. By convention, a run begins in
the state after a rise from below long ago. The axes are therefore retracted a little and raised
again before the run.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import AttachedEffect, AxisProperties, ForceFunction

# Retraction of an axis, relative to its range.
_RETRACTION_RANGE_RATIO = 0.002
# Duration of the retraction, in periods of the slowest vibration.
_RETRACTION_PERIODS = 10.0
# Duration of the rise, in time constants of that vibration.
_RISE_TIME_CONSTANTS = 20.0
# An axis with less damping is treated as if it had this damping ratio.
_MIN_DAMPING_RATIO = 0.005
_ROWS_PER_PERIOD = 8


class SettlingPath(NamedTuple):
    """Path to rest.

    ``time_s`` (n,) from 0 on; ``retraction`` (n, axes): how far each axis is retracted, m or rad.
    """

    time_s: FloatArray
    retraction: FloatArray


def needs_settling(facts: AxisProperties) -> bool:
    """Return whether an axis settles under its input.

    An axis that is moved by a force does not: it is placed at its command.
    """
    return facts.stiffness > 0.0 and facts.kind != "force"


def make_settling_path(axes: Sequence[str], effects: Sequence[AttachedEffect]) -> SettlingPath:
    """Return the path to rest of a machine with these effects.

    The rise is ``(1 + t/τ) exp(−t/τ)`` with the time constant τ of the slowest vibration, so the
    axis never runs ahead of its input: ``M |ẍ| < D |ẋ|``. It slides until it stops, and dry
    friction ends where it would after an infinitely slow rise. The retraction that remains at the
    end is removed linearly over the rise.
    """
    settling_axes: dict[str, AxisProperties] = {
        effect.entry.axis: effect.facts
        for effect in effects
        if isinstance(effect.formulation.acts, ForceFunction) and needs_settling(effect.facts)
    }
    slowest_hz = min(facts.frequency_hz for facts in settling_axes.values())
    decay_rate = min(
        2.0 * np.pi * facts.frequency_hz * max(facts.damping_ratio, _MIN_DAMPING_RATIO)
        for facts in settling_axes.values()
    )
    retraction_s = _RETRACTION_PERIODS / slowest_hz
    rows = int(
        np.ceil((retraction_s + _RISE_TIME_CONSTANTS / decay_rate) * slowest_hz * _ROWS_PER_PERIOD)
    )
    time_s = np.arange(1, rows + 1) / (slowest_hz * _ROWS_PER_PERIOD)
    retraction_profile = 0.5 - 0.5 * np.cos(np.pi * np.minimum(time_s / retraction_s, 1.0))
    rise_time = np.maximum(time_s - retraction_s, 0.0) * decay_rate
    rise_profile = (1.0 + rise_time) * np.exp(-rise_time)
    rise_profile -= rise_profile[-1] * rise_time / rise_time[-1]
    max_retraction = np.array(
        [
            _RETRACTION_RANGE_RATIO * settling_axes[name].span if name in settling_axes else 0.0
            for name in axes
        ]
    )
    return SettlingPath(time_s, np.outer(retraction_profile * rise_profile, max_retraction))
