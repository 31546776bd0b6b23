"""Feed-forward by the inverse of the model: what to command so that the axis makes a given move."""

from math import pi
from typing import NamedTuple

import numpy as np

from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.move_shape import Shape, summed

_JUMP = 1e-6  # of the greatest acceleration: what rounding may leave


class Lead(NamedTuple):
    """Shares of speed (s) and acceleration (s²) that are added to a position."""

    speed_s: float
    acceleration_s2: float


def inverse_of(frequency_hz: float, damping_ratio: float, hold_s: float = 0.0) -> Lead:
    """Return the inverse, to second order in s, of an axis whose command is held for ``hold_s``.

    The axis is ``1 / (1 + 2ζ s/ω + s²/ω²)``, which is inverted exactly; holding each command until
    the next delays it by half of ``hold_s``, ``e^(−s h/2)``, of which two terms are inverted.
    """
    rate = 2.0 * pi * frequency_hz
    lag_s, half_s = 2.0 * damping_ratio / rate, 0.5 * hold_s
    return Lead(lag_s + half_s, 1.0 / rate**2 + lag_s * half_s + 0.5 * half_s**2)


def led(shape: Shape, lead: Lead) -> Shape:
    """Return ``x + a ẋ + b ẍ``.

    Raises
    ------
    ShapingError
        If the acceleration of the move jumps: the position of what is commanded would jump too.
    """
    jump, greatest = shape.jump(2), shape.greatest(2)
    if jump > _JUMP * greatest:
        raise ShapingError(
            message(
                "engine",
                "feed-forward: the acceleration of the profile jumps by {jump} (SI units), "
                "with a maximum of {greatest}; use an S-curve or minimum jerk, or input shaping",
            ).fill(jump=rounded(jump, 3), greatest=rounded(greatest, 3))
        )
    polynomial = shape.polynomial
    parts = (
        polynomial.c,
        lead.speed_s * polynomial.derivative(1).c,
        lead.acceleration_s2 * polynomial.derivative(2).c,
    )
    return summed(shape.breaks_s, *(np.asarray(part) for part in parts))
