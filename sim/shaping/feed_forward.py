"""Feed-forward by the inverse of the model: the command that makes an axis perform a move."""

from math import pi
from typing import NamedTuple

import numpy as np

from rotemina.sim.errors import ShapingError
from rotemina.sim.messages import format_rounded
from rotemina.sim.shaping.move_shape import MoveShape, sum_coefficients

# Largest jump of the acceleration that counts as rounding, as a share of the largest acceleration.
_MAX_JUMP_RATIO = 1e-6


class LeadCoefficients(NamedTuple):
    """Factors of speed (s) and acceleration (s²), whose products are added to a position."""

    speed_s: float
    acceleration_s2: float


def invert_axis(frequency_hz: float, damping_ratio: float, hold_s: float = 0.0) -> LeadCoefficients:
    """Return the inverse, to second order in s, of an axis whose command is held for ``hold_s``.

    The axis is ``1 / (1 + 2ζ s/ω + s²/ω²)``, which is inverted exactly. Holding each command until
    the next delays it by half of ``hold_s``, ``e^(−s h/2)``, which is inverted to second order.
    """
    omega = 2.0 * pi * frequency_hz
    lag_s, half_s = 2.0 * damping_ratio / omega, 0.5 * hold_s
    return LeadCoefficients(lag_s + half_s, 1.0 / omega**2 + lag_s * half_s + 0.5 * half_s**2)


def apply_lead(shape: MoveShape, lead: LeadCoefficients) -> MoveShape:
    """Return the move ``x + a ẋ + b ẍ``.

    Raises
    ------
    ShapingError
        If the acceleration of the move jumps, because the commanded position would jump too.
    """
    jump, max_acceleration = shape.max_jump(2), shape.max_magnitude(2)
    if jump > _MAX_JUMP_RATIO * max_acceleration:
        raise ShapingError(
            "feed-forward: the acceleration of the profile jumps by {jump} (SI units), "
            "with a maximum of {greatest}; use an S-curve or minimum jerk, or input shaping",
            jump=format_rounded(jump, 3),
            greatest=format_rounded(max_acceleration, 3),
        )
    polynomial = shape.polynomial
    parts = (
        polynomial.c,
        lead.speed_s * polynomial.derivative(1).c,
        lead.acceleration_s2 * polynomial.derivative(2).c,
    )
    return sum_coefficients(shape.breaks_s, *(np.asarray(part) for part in parts))
